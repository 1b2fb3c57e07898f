#include "engine/io/gltf_accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "engine/data/error.h"

namespace spherematch {

namespace {

template <typename Number>
Number load(const unsigned char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(Number));
  return number;
}

/// As the glTF specification turns normalised integers into floats, section 3.11.
template <typename Integer>
double fraction(Integer value, bool normalized) {
  if (!normalized) return value;
  return std::max(static_cast<double>(value) / std::numeric_limits<Integer>::max(), -1.0);
}

/// The first of equally spaced elements.
struct Elements {
  const unsigned char* first;
  std::size_t stride;

  [[nodiscard]] const unsigned char* at(std::size_t i) const { return first + i * stride; }
};

class AccessorReader {
 public:
  AccessorReader(const tinygltf::Model& model, int index) : model_(model), part_{"accessor", index}, accessor_(checked(index)) {}

  [[nodiscard]] std::size_t count() const { return accessor_.count; }

  /// The bytes of a position's coordinate, after checking that all positions are there.
  [[nodiscard]] std::size_t check_positions() const {
    if (accessor_.type != TINYGLTF_TYPE_VEC3) part_.fail("positions must be of type VEC3");
    const std::size_t size = position_component_size();
    (void)locate_all(3 * size);
    return size;
  }

  void check_indices() const {
    if (accessor_.type != TINYGLTF_TYPE_SCALAR) part_.fail("indices must be of type SCALAR");
    (void)locate_all(index_size(accessor_.componentType));
  }

  void read(Eigen::Ref<Points> points) const {
    const std::size_t size = check_positions();
    for_each(3 * size, [&](std::size_t i, const unsigned char* element) {
      for (std::size_t k = 0; k < 3; ++k)
        points(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = coordinate(element + k * size);
    });
  }

  void read(std::vector<std::uint32_t>& indices) const {
    check_indices();
    const int type = accessor_.componentType;
    for_each(index_size(type), [&](std::size_t i, const unsigned char* element) { indices[i] = index_at(element, type); });
  }

 private:
  [[nodiscard]] const tinygltf::Accessor& checked(int index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size()) part_.fail("there is no such accessor");
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
    if (accessor.count == 0) part_.fail("it has no elements");
    return accessor;
  }

  /// Where the elements are, and those that a sparse accessor replaces.
  struct Parts {
    Elements base{nullptr, 0};  ///< null when there is no buffer view
    std::size_t replaced = 0;
    Elements indices{nullptr, 0};
    Elements values{nullptr, 0};
  };

  [[nodiscard]] Parts locate_all(std::size_t element_size) const {
    const auto& sparse = accessor_.sparse;
    if (accessor_.bufferView < 0 && !sparse.isSparse) part_.fail("it has no data");
    Parts parts;
    if (accessor_.bufferView >= 0) parts.base = locate(accessor_.bufferView, accessor_.byteOffset, count(), element_size);
    if (!sparse.isSparse) return parts;
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > count()) part_.fail("its sparse part has a wrong count");
    parts.replaced = static_cast<std::size_t>(sparse.count);
    parts.indices = locate(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), parts.replaced,
                           index_size(sparse.indices.componentType));
    parts.values = locate(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), parts.replaced, element_size);
    return parts;
  }

  /// Calls visit(i, element) for the elements of the buffer view, then for those that the sparse part replaces.
  template <typename Visit>
  void for_each(std::size_t element_size, const Visit& visit) const {
    const Parts parts = locate_all(element_size);
    if (parts.base.first != nullptr)
      for (std::size_t i = 0; i < count(); ++i) visit(i, parts.base.at(i));
    for (std::size_t i = 0; i < parts.replaced; ++i) {
      const std::uint32_t index = index_at(parts.indices.at(i), accessor_.sparse.indices.componentType);
      if (index >= count()) part_.fail("its sparse part replaces element " + std::to_string(index) + " of " + std::to_string(count()));
      visit(index, parts.values.at(i));
    }
  }

  /// `count` is at least one. Subtracts and divides where adding and multiplying could overflow.
  [[nodiscard]] Elements locate(int view_index, std::size_t offset, std::size_t count, std::size_t element_size) const {
    if (view_index < 0 || static_cast<std::size_t>(view_index) >= model_.bufferViews.size())
      part_.fail("there is no buffer view " + std::to_string(view_index));
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(view_index)];
    const GltfPart view_part{"buffer view", view_index};
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model_.buffers.size())
      view_part.fail("there is no buffer " + std::to_string(view.buffer));
    const std::vector<unsigned char>& data = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) view_part.fail("it ends beyond its buffer");
    const std::size_t stride = view.byteStride == 0 ? element_size : view.byteStride;
    if (stride < element_size) view_part.fail("its stride is smaller than an element");
    const bool fits = offset <= view.byteLength && element_size <= view.byteLength - offset &&
                      count - 1 <= (view.byteLength - offset - element_size) / stride;
    if (!fits) part_.fail("it ends beyond buffer view " + std::to_string(view_index));
    return {data.data() + view.byteOffset + offset, stride};
  }

  [[nodiscard]] std::size_t position_component_size() const {
    switch (accessor_.componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
      case TINYGLTF_COMPONENT_TYPE_SHORT:
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
      default:
        part_.fail("positions cannot have the component type " + std::to_string(accessor_.componentType));
    }
  }

  [[nodiscard]] double coordinate(const unsigned char* bytes) const {
    switch (accessor_.componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return fraction(load<std::int8_t>(bytes), accessor_.normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return fraction(load<std::uint8_t>(bytes), accessor_.normalized);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return fraction(load<std::int16_t>(bytes), accessor_.normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return fraction(load<std::uint16_t>(bytes), accessor_.normalized);
      default:
        return load<float>(bytes);
    }
  }

  [[nodiscard]] std::size_t index_size(int component_type) const {
    switch (component_type) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return 4;
      default:
        part_.fail("indices cannot have the component type " + std::to_string(component_type));
    }
  }

  [[nodiscard]] static std::uint32_t index_at(const unsigned char* bytes, int component_type) {
    switch (component_type) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return *bytes;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(bytes);
      default:
        return load<std::uint32_t>(bytes);
    }
  }

  const tinygltf::Model& model_;
  GltfPart part_;
  const tinygltf::Accessor& accessor_;
};

}  // namespace

std::string GltfPart::place() const { return std::string(kind) + ' ' + std::to_string(index) + ": "; }

void GltfPart::fail(const std::string& message) const { throw EngineError(ErrorCode::malformed_mesh, place() + message); }

std::int64_t position_count(const tinygltf::Model& model, int accessor) {
  const AccessorReader reader(model, accessor);
  (void)reader.check_positions();
  return static_cast<std::int64_t>(reader.count());
}

std::int64_t index_count(const tinygltf::Model& model, int accessor) {
  const AccessorReader reader(model, accessor);
  reader.check_indices();
  return static_cast<std::int64_t>(reader.count());
}

void read_positions(const tinygltf::Model& model, int accessor, Eigen::Ref<Points> points) {
  points.setZero();
  AccessorReader(model, accessor).read(points);
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor) {
  const AccessorReader reader(model, accessor);
  std::vector<std::uint32_t> indices(reader.count());
  reader.read(indices);
  return indices;
}

}  // namespace spherematch
