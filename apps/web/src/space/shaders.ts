// SPDX-License-Identifier: Apache-2.0
// The programs of the graphics processor. Light is that of a diffuse surface (Lambert): what comes from all sides, and a
// lamp beside the camera. Colors are linear until the end, where they become sRGB (IEC 61966-2-1).

/** How a program differs from another one. */
export interface Look {
  isRods: boolean;
  isLit: boolean;
  isFlat: boolean; // has no normals
  hasColors: boolean; // each point has one
}

export const kPlaces = { point: 0, normal: 1, color: 2, from: 3, to: 4 } as const;

export function vertexShader({ isRods, isLit, isFlat, hasColors }: Look): string {
  const hasNormals = isLit && !isFlat;
  return `#version 300 es
precision highp float;
layout(location = ${kPlaces.point}) in vec3 point;
${hasNormals ? `layout(location = ${kPlaces.normal}) in vec3 normal;` : ''}
${hasColors ? `layout(location = ${kPlaces.color}) in vec3 color;` : 'uniform vec3 color;'}
${isRods ? `layout(location = ${kPlaces.from}) in vec3 from;\nlayout(location = ${kPlaces.to}) in vec4 to;` : ''}
uniform mat4 view, projection;
uniform vec3 at;
out vec3 place, facing, tint;
void main() {
  ${isRods ? `
  vec3 axis = to.xyz - from;
  float size = length(axis) > 1e-6 ? to.w : 0.0;
  vec3 along = size > 0.0 ? normalize(axis) : vec3(0.0, 1.0, 0.0);
  vec3 side = normalize(cross(along, abs(along.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
  vec3 other = cross(side, along);
  vec3 moved = mix(from, to.xyz, point.y + 0.5) + size * (point.x * side + point.z * other);
  vec3 turned = normal.y / max(length(axis), 1e-6) * along + (normal.x * side + normal.z * other) / max(size, 1e-6);` : `
  vec3 moved = point;
  ${hasNormals ? 'vec3 turned = normal;' : ''}`}
  ${hasNormals ? 'facing = mat3(view) * turned;' : ''}
  tint = color;
  vec4 seen = view * vec4(moved + at, 1.0);
  place = seen.xyz;
  gl_Position = projection * seen;
}`;
}

export function fragmentShader({ isLit, isFlat }: Look): string {
  return `#version 300 es
precision highp float;
in vec3 place, facing, tint;
uniform vec3 lamp;
uniform float opacity;
out vec4 drawn;
const float kAround = 2.1 / 3.14159265, kLamp = 1.1 / 3.14159265;
void main() {
  vec3 shade = tint;
  ${isLit ? `vec3 normal = normalize(${isFlat ? 'cross(dFdx(place), dFdy(place))' : 'gl_FrontFacing ? facing : -facing'});
  shade *= kAround + kLamp * max(dot(normal, lamp), 0.0);` : ''}
  vec3 bright = 1.055 * pow(shade, vec3(1.0 / 2.4)) - 0.055;
  drawn = vec4(mix(bright, 12.92 * shade, vec3(lessThanEqual(shade, vec3(0.0031308)))), opacity);
}`;
}
