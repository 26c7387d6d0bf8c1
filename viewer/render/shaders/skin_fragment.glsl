#version 330 core
// The nearest layer of the surface, in front of or behind what is drawn already.
uniform sampler2D skin;
uniform sampler2D skin_depth;
in vec2 place;
out vec4 result;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 colour = texelFetch(skin, at, 0);
  if (colour.a == 0.0) discard;
  result = colour;
  gl_FragDepth = texelFetch(skin_depth, at, 0).r;
}
