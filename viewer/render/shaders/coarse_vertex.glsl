// The surface lit at its vertices, for machines to which pixels are dear.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 colour;
layout(location = 9) in vec2 place_in_picture;
uniform mat4 view;
uniform mat4 projection;
uniform bool orthographic;
uniform bool skin;
uniform float strength;
out vec4 shade;
out vec2 place;
void main() {
  vec4 at = view * vec4(position, 1.0);
  vec3 to_viewer = orthographic ? vec3(0.0, 0.0, 1.0) : normalize(-at.xyz);
  vec3 facing = mat3(view) * normal.xyz;
  facing = dot(facing, facing) > 0.0 ? normalize(facing) : to_viewer;
  if (dot(facing, to_viewer) < 0.0) facing = -facing;
  shade = vec4(lit(colour.rgb, facing, to_viewer), 1.0);
  if (skin) shade = glass(shade.rgb, colour.rgb, dot(facing, to_viewer), strength);
  place = place_in_picture;
  gl_Position = projection * at;
}
