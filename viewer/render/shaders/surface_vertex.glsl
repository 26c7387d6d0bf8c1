#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 colour;
layout(location = 9) in vec2 place_in_picture;
uniform mat4 view;
uniform mat4 projection;
out vec3 seen;
out vec3 normal_seen;
out vec4 tint;
flat out vec4 tint_of_face;
out vec2 place;
void main() {
  vec4 at = view * vec4(position, 1.0);
  seen = at.xyz;
  normal_seen = mat3(view) * normal.xyz;
  tint = tint_of_face = colour;
  place = place_in_picture;
  gl_Position = projection * at;
}
