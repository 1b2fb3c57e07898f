// One shape on the stage: its buffers on the graphics card, and what a ray meets on it.
import {BufferAttribute, BufferGeometry, LineSegments, Matrix3, Matrix4, Mesh, Quaternion, Ray, ShaderMaterial, Vector3} from 'three';
import {MeshBVH} from 'three-mesh-bvh';
import {MISSING, MODES, SPHERE_RADIUS, ramp, surfaceMaterial, wireMaterial} from './material.js';

export class Surface {
  /** `places`: normalised positions; `normals`, `index` as uploaded. */
  constructor({places, normals, index}) {
    this.count = places.length / 3;
    this.places = places;
    this.index = index;
    this.sphere = null;
    this.goal = null;
    this.geometry = new BufferGeometry();
    this.geometry.setIndex(new BufferAttribute(index, 1));
    this.setAttribute('position', places);
    if (normals) this.setAttribute('normal', normals);
    else this.geometry.computeVertexNormals();
    this.material = surfaceMaterial();
    this.mesh = new Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.trees = new Map();
    this.wires = null;
    this.links = null;
    this.drop = () => [this.geometry, this.material, this.wires?.material, this.links?.geometry, this.links?.material].forEach((part) => part?.dispose());
  }

  get isMorphing() {
    return this.uniforms.toGoal.value > 0;
  }

  get uniforms() {
    return this.material.uniforms;
  }

  setAttribute(name, values, width = 3) {
    const before = this.geometry.getAttribute(name);
    if (before) {
      // A buffer that is replaced would stay on the graphics card.
      before.array = values;
      before.needsUpdate = true;
    } else {
      this.geometry.setAttribute(name, new BufferAttribute(values, width));
    }
  }

  /** Points on the unit sphere; NaN where repair dropped a vertex. */
  setSphere(points) {
    this.sphere = points.map((value) => (Number.isFinite(value) ? value : 0));
    this.setAttribute('sphere', this.sphere);
    this.trees.delete('sphere');
  }

  /** Where the morph leads, in the frame of `places`. Vertices without an image stay. */
  setGoal(points, normals) {
    this.goal = points.map((value, i) => (Number.isFinite(value) ? value : this.places[i]));
    const own = this.geometry.getAttribute('normal').array;
    this.setAttribute('goal', this.goal);
    this.setAttribute('goalNormal', normals.map((value, i) => (Number.isFinite(value) ? value : own[i])));
    this.trees.delete('goal');
  }

  /** `paint`: {mode, values, width, range, map}; see paints.js. */
  setPaint(paint) {
    this.uniforms.mode.value = MODES[paint.mode];
    if (paint.mode === 'plain') return;
    const values = new Float32Array(this.count * 3);
    for (let i = 0; i < this.count; ++i) {
      for (let k = 0; k < 3; ++k) {
        const value = k < paint.width ? paint.values[i * paint.width + k] : 0;
        values[i * 3 + k] = Number.isFinite(value) ? value : MISSING;
      }
    }
    this.setAttribute('paint', values);
    if (paint.range) this.uniforms.range.value = {x: paint.range[0], y: paint.range[1]};
    if (paint.map) this.uniforms.ramp.value = ramp(paint.map);
  }

  showWires(shown) {
    if (shown && !this.wires) {
      this.wires = new Mesh(this.geometry, wireMaterial(this.material));
      this.wires.frustumCulled = false;
      this.mesh.add(this.wires);
    }
    if (this.wires) this.wires.visible = shown;
  }

  /** Lines between vertices and their mirror images. `distance` is that of each vertex to its mirror image. */
  setSymmetry(distance, ends) {
    this.setAttribute('mirror', distance, 1);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(ends, 3));
    const material = new ShaderMaterial({
      vertexShader: 'uniform mat3 surfaceTurn; void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(surfaceTurn * position, 1.0); }',
      fragmentShader: 'void main() { gl_FragColor = vec4(0.98, 0.20, 0.42, 0.5); }',
      transparent: true,
      depthTest: false,
    });
    material.uniforms = {surfaceTurn: this.uniforms.surfaceTurn};
    this.links = new LineSegments(geometry, material);
    this.links.frustumCulled = false;
    this.mesh.add(this.links);
  }

  showSymmetry(shown) {
    const there = shown && this.links !== null;
    this.uniforms.mirrored.value = there;
    if (this.links) this.links.visible = there && this.uniforms.toSphere.value === 0 && this.uniforms.toGoal.value === 0;
  }

  setTurns(surface, sphere) {
    this.uniforms.surfaceTurn.value.setFromMatrix4(new Matrix4().makeRotationFromQuaternion(surface));
    this.uniforms.sphereTurn.value.fromArray(sphere).transpose();
  }

  setForm(toSphere, toGoal) {
    this.uniforms.toSphere.value = this.sphere ? toSphere : 0;
    this.uniforms.toGoal.value = this.goal ? toGoal : 0;
  }

  /** A point of the surface as it is drawn, before the camera; `corners` and `bary` as of a map. */
  drawnPoint(corners, bary) {
    const sum = (values) => new Vector3(...[0, 1, 2].map((k) => corners.reduce((total, corner, c) => total + bary[c] * values[3 * corner + k], 0)));
    const {toSphere, toGoal, surfaceTurn, sphereTurn} = this.uniforms;
    const place = sum(this.places);
    if (toGoal.value > 0) place.lerp(sum(this.goal), toGoal.value);
    place.applyMatrix3(surfaceTurn.value);
    if (toSphere.value > 0) place.lerp(sum(this.sphere).normalize().applyMatrix3(sphereTurn.value).multiplyScalar(SPHERE_RADIUS), toSphere.value);
    return place;
  }

  /** What a ray in the frame before the camera meets first: {vertex, point, distance}, or null. */
  meet(ray) {
    const {toSphere, toGoal, surfaceTurn, sphereTurn} = this.uniforms;
    const onSphere = toSphere.value > 0.5;
    const back = (onSphere ? sphereTurn.value : surfaceTurn.value).clone().invert();
    const local = new Ray(ray.origin.clone().applyMatrix3(back), ray.direction.clone().applyMatrix3(back));
    if (onSphere) local.origin.divideScalar(SPHERE_RADIUS);
    const form = onSphere ? 'sphere' : toGoal.value > 0 ? 'goal' : 'surface';
    const {tree, values} = this.tree(form, toGoal.value);
    const hit = tree.raycastFirst(local, 2);
    if (!hit) return null;
    const {a, b, c} = hit.face;
    const squared = (v) => (values[3 * v] - hit.point.x) ** 2 + (values[3 * v + 1] - hit.point.y) ** 2 + (values[3 * v + 2] - hit.point.z) ** 2;
    const vertex = [a, b, c].sort((u, v) => squared(u) - squared(v) || u - v)[0];
    return {vertex, distance: hit.distance * (onSphere ? SPHERE_RADIUS : 1)};
  }

  /** The search tree over one form. That of a morph under way is made anew for each share. */
  tree(form, share) {
    const known = this.trees.get(form);
    if (known && (form !== 'goal' || known.share === share)) return known;
    const values = form === 'surface' ? this.places : form === 'sphere' ? this.sphere : this.places.map((value, i) => value + share * (this.goal[i] - value));
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(values, 3));
    geometry.setIndex(new BufferAttribute(this.index, 1));
    const made = {tree: new MeshBVH(geometry, {indirect: true}), values, share};
    this.trees.set(form, made);
    return made;
  }
}

export const IDENTITY_TURN = new Quaternion();
export const IDENTITY_MATRIX = new Matrix3().toArray();
