// How a surface is drawn: between its forms (surface, sphere, image) and in its paint.
import {DataTexture, DoubleSide, LinearFilter, Matrix3, RGBAFormat, ShaderMaterial, Vector3} from 'three';
import {mapTexels} from './colours.js';

/** Values of the uniform `mode`. */
export const MODES = {colour: 0, scalar: 1, checker: 2, plain: 3};

/** Marks a vertex without a value in the attribute `paint`. */
export const MISSING = -1e4;

const VERTEX = /* glsl */ `
attribute vec3 sphere;
attribute vec3 goal;
attribute vec3 goalNormal;
attribute vec3 paint;
attribute float mirror;
uniform float toSphere;
uniform float toGoal;
uniform mat3 surfaceTurn;
uniform mat3 sphereTurn;
uniform float sphereRadius;
varying vec3 vNormal;
varying vec3 vPaint;
varying vec3 vView;
varying float vMirror;
void main() {
  vec3 place = surfaceTurn * mix(position, goal, toGoal);
  vec3 direction = surfaceTurn * mix(normal, goalNormal, toGoal);
  vec3 onSphere = sphereTurn * sphere;
  place = mix(place, onSphere * sphereRadius, toSphere);
  direction = mix(direction, onSphere, toSphere);
  vNormal = normalMatrix * direction;
  vPaint = paint;
  vMirror = mirror;
  vec4 view = modelViewMatrix * vec4(place, 1.0);
  vView = -view.xyz;
  gl_Position = projectionMatrix * view;
}`;

const FRAGMENT = /* glsl */ `
uniform int mode;
uniform bool shade;
uniform bool wire;
uniform bool mirrored;
uniform vec3 plain;
uniform vec3 missing;
uniform vec3 wireColour;
uniform sampler2D ramp;
uniform vec2 range;
varying vec3 vNormal;
varying vec3 vPaint;
varying vec3 vView;
varying float vMirror;

vec3 checker(vec2 place) {
  // Squares blurred over the width of a pixel.
  vec2 width = max(fwidth(place), 1e-4);
  vec2 wave = abs(fract(place * 0.5) - 0.5) * 2.0 - 0.5;
  vec2 sides = clamp(wave / width, -0.5, 0.5);
  float dark = 0.5 - 2.0 * sides.x * sides.y;
  return mix(vec3(0.95, 0.93, 0.88), vec3(0.16, 0.40, 0.50), dark);
}

vec3 painted() {
  if (mode == ${MODES.plain}) return plain;
  if (vPaint.x < ${MISSING / 100}.0) return missing;
  if (mode == ${MODES.checker}) return checker(vPaint.xy);
  if (mode == ${MODES.scalar}) {
    float share = clamp((vPaint.x - range.x) / max(range.y - range.x, 1e-12), 0.0, 1.0);
    return texture2D(ramp, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  }
  return vPaint;
}

void main() {
  if (wire) {
    gl_FragColor = vec4(wireColour, 0.24);
    return;
  }
  vec3 colour = painted();
  if (mirrored) colour = mix(vec3(0.98, 0.20, 0.42), colour, smoothstep(0.012, 0.02, vMirror));
  if (shade) {
    vec3 n = normalize(vNormal);
    if (!gl_FrontFacing) n = -n;
    vec3 v = normalize(vView);
    float key = max(dot(n, normalize(vec3(-0.35, 0.55, 0.75))), 0.0);
    float sky = 0.5 + 0.5 * n.y;
    float rim = pow(1.0 - max(dot(n, v), 0.0), 3.0);
    colour = colour * (0.50 + 0.16 * sky + 0.42 * key) + vec3(0.10) * rim * sky + vec3(0.05) * pow(key, 12.0);
  }
  gl_FragColor = vec4(colour, 1.0);
}`;

function rampTexture(name) {
  const texture = new DataTexture(mapTexels(name), 256, 1, RGBAFormat);
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

const ramps = new Map();
export function ramp(name) {
  if (!ramps.has(name)) ramps.set(name, rampTexture(name));
  return ramps.get(name);
}

export const SPHERE_RADIUS = 0.46;

export function surfaceMaterial() {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    uniforms: {
      toSphere: {value: 0},
      toGoal: {value: 0},
      surfaceTurn: {value: new Matrix3()},
      sphereTurn: {value: new Matrix3()},
      sphereRadius: {value: SPHERE_RADIUS},
      mode: {value: MODES.plain},
      shade: {value: true},
      wire: {value: false},
      mirrored: {value: false},
      plain: {value: new Vector3(0.72, 0.73, 0.74)},
      missing: {value: new Vector3(0.55, 0.55, 0.56)},
      wireColour: {value: new Vector3(0.05, 0.06, 0.08)},
      ramp: {value: ramp('viridis')},
      range: {value: {x: 0, y: 1}},
    },
  });
}

/** The same places, drawn as edges. It shares the uniforms that place the surface. */
export function wireMaterial(of) {
  const material = new ShaderMaterial({vertexShader: VERTEX, fragmentShader: FRAGMENT, wireframe: true, transparent: true, depthWrite: false});
  material.uniforms = {...of.uniforms, wire: {value: true}};
  return material;
}
