#version 330 core
uniform vec4 upper;
uniform vec4 lower;
in vec2 place;
out vec4 result;
void main() { result = mix(lower, upper, smoothstep(0.0, 1.0, place.y)); }
