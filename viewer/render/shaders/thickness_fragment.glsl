#version 330 core
// Added up over all faces: for a closed surface the length of the ray that lies inside.
uniform bool orthographic;
in vec3 seen;
out float result;
void main() {
  float depth = orthographic ? -seen.z : length(seen);
  result = gl_FrontFacing ? -depth : depth;
}
