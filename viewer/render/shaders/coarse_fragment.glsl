#version 330 core
uniform vec3 inner;
in vec4 shade;
out vec4 result;
void main() { result = gl_FrontFacing ? shade : vec4(shade.rgb * inner, shade.a); }
