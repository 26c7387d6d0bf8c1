// Light that makes shape readable: a key light from the upper left of the viewer, a weak fill from
// the right, sky above and ground below, and a little gloss. Everything in the camera's frame.
vec3 lit(vec3 albedo, vec3 normal, vec3 to_viewer) {
  const vec3 key = normalize(vec3(-0.5, 0.7, 0.65));
  const vec3 fill = normalize(vec3(0.85, 0.05, 0.5));
  float sky = 0.5 + 0.5 * normal.y;
  float wrapped = max(0.0, (dot(normal, key) + 0.15) / 1.15);
  vec3 colour = albedo * (mix(0.20, 0.34, sky) + 0.62 * wrapped + 0.16 * max(0.0, dot(normal, fill)));
  float gloss = pow(max(0.0, dot(normal, normalize(key + to_viewer))), 42.0);
  return colour + vec3(0.10 * gloss);
}
// Glass, the more opaque the more it turns away; `facing` is the cosine to the viewer. It is not
// black where it turns away.
vec4 glass(vec3 colour, vec3 own, float facing, float strength) {
  float away = 1.0 - abs(facing);
  colour = mix(colour, own * 0.82, 0.75 * away * away);
  float alpha = clamp(strength * (0.30 + 0.95 * away * away), 0.0, 1.0);
  return vec4(colour * alpha, alpha);
}
