#version 330 core
uniform vec4 line;
in vec3 seen;
in vec3 normal_seen;
in vec4 tint;
out vec4 result;
void main() { result = vec4(line.rgb * line.a, line.a) + 0.0 * tint; }
