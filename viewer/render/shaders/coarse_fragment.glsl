#version 330 core
uniform vec3 inner;
uniform sampler2D picture;
uniform bool has_picture;
uniform bool cut_out;
in vec4 shade;
in vec2 place;
out vec4 result;
void main() {
  result = gl_FrontFacing ? shade : vec4(shade.rgb * inner, shade.a);
  if (!has_picture) return;
  vec4 there = texture(picture, place);
  if (cut_out && there.a < 0.5) discard;
  result.rgb *= there.rgb;
}
