#include <sstream>

#include <curveskel/certificate.hpp>

namespace curveskel {
namespace {

/// "99.850 %".
std::string percent_words(double share, int digits) {
  std::ostringstream words;
  words.setf(std::ios::fixed);
  words.precision(digits);
  words << 100 * share << " %";
  return words.str();
}

}  // namespace

std::string failures(const Certificate& certificate, const CertificateOptions& options) {
  const Certificate& c = certificate;
  const auto number = [](int count) { return std::to_string(count); };
  std::string text;
  const auto add = [&text](const std::string& failure) {
    text += (text.empty() ? "" : "; ") + failure;
  };
  if (c.components != c.components_of_surface) {
    add("the skeleton has " + number(c.components) + " components, the surface " +
        number(c.components_of_surface));
  } else if (!c.components_right() && c.components_of_surface == 1) {
    add("no node of the skeleton is inside the surface, or near it");
  } else if (!c.components_right()) {
    add(number(c.components_without_curve) + " of the surface's " +
        number(c.components_of_surface) + " components have no component of the skeleton inside");
  }
  if (c.cycle_rank != c.genus) {
    add("the skeleton has " + number(c.cycle_rank) + " independent cycles, the surface genus " +
        number(c.genus));
  } else if (c.homology_rank != c.genus) {
    add("of the skeleton's " + number(c.cycle_rank) + " cycles only " + number(c.homology_rank) +
        " go round handles of the surface independently");
  }
  if (!c.inside_enough) {
    add(percent_words(c.inside_fraction, 3) + " of the length is inside, needed " +
        percent_words(options.inside_needed, 1));
  }
  return text;
}

std::string tip_failure(const Certificate& certificate) {
  if (certificate.reaches_ends()) return {};
  return "a tip stops short of the end of its limb: the surface ahead of it is " +
         percent_words(certificate.reach_at_tips, 0) + " of D from the curve, needed " +
         percent_words(reach_at_tips_allowed, 0) +
         " or less; correct the curve there (`view`), or extract it anew";
}

std::string shape_failure(const Certificate& certificate) {
  if (certificate.curve_like) return {};
  return "the surface is not made of tubes: " + percent_words(certificate.tube_share, 0) +
         " of its area is within 2.5 inscribed radii of the curve, needed " +
         percent_words(tube_share_needed, 0) + "; a curve says little of such a shape";
}

std::string wrap_failure(const Certificate& certificate) {
  if (certificate.wrap_follows()) return {};
  return "the wrap is another shape than the surface given: " +
         percent_words(certificate.wrap_followed, 0) +
         " of the area lies within D / 100 of the surface given, needed " +
         percent_words(wrap_followed_needed, 0) + "; choose a narrower --wrap-gap, or --wrap never";
}

}  // namespace curveskel
