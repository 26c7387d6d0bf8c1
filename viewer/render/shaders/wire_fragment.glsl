#version 330 core
uniform vec4 line;
out vec4 result;
void main() { result = vec4(line.rgb * line.a, line.a); }
