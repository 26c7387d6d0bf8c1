#version 330 core
// Added up over all faces: for a closed surface the length of the ray that lies inside.
uniform bool orthographic;
in vec3 seen;
in vec3 normal_seen;
in vec4 tint;
out vec4 result;
void main() {
  float depth = orthographic ? -seen.z : length(seen);
  result = vec4(gl_FrontFacing ? -depth : depth, tint.rgb * 0.0);
}
