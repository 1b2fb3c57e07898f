// tinygltf compiled here, so that the sanitizers watch it too; the packaged library is built without them.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
