#version 330 core
// Where things are, and nothing else about them.
layout(location = 0) in vec3 position;
uniform mat4 view;
uniform mat4 projection;
out vec3 seen;
void main() {
  vec4 at = view * vec4(position, 1.0);
  seen = at.xyz;
  gl_Position = projection * at;
}
