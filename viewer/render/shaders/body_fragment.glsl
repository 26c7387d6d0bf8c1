#version 330 core
// What a ray loses on its way through the body.
uniform sampler2D thickness;
uniform vec3 tint;
uniform float half_length;  // model units after which half of the light is lost
uniform float most;         // that is ever lost
in vec2 place;
out vec4 result;
void main() {
  float inside = max(0.0, texelFetch(thickness, ivec2(gl_FragCoord.xy), 0).r);
  float alpha = most * (1.0 - exp2(-inside / half_length));
  result = vec4(tint * alpha, alpha);
}
