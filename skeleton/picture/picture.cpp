#include "skeleton/picture/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/view.hpp>
#include "base/base64.hpp"
#include "base/decimal.hpp"
#include "skeleton/picture/image.hpp"
#include "skeleton/picture/marks.hpp"
#include "skeleton/picture/shade_surface.hpp"

namespace curveskel {
namespace {

Image picture_of(const Surface& surface, const std::array<View, 2>& views,
                 const PictureOptions& options) {
  Image image(options.width, options.height, Colour(1, 1, 1));
  const Positions normals = vertex_normals(surface);
  for (const View& view : views) shade_surface(surface, normals, view, options.threads, image);
  return image;
}

/// Widths are chosen for 1600 x 1200 pixels.
double width_unit(const PictureOptions& options) {
  constexpr double usual_side = 1200;
  return std::min(options.width, options.height) / usual_side;
}

/// A hundredth of a pixel is finer than anybody sees.
void append_attribute(std::string& text, std::string_view name, double pixels) {
  text.append(" ").append(name).append("=\"");
  append_decimal(text, std::round(pixels * 100) / 100);
  text += '"';
}

void append_colour(std::string& text, std::string_view name, const Colour& colour) {
  constexpr std::string_view digits = "0123456789abcdef";
  text.append(" ").append(name).append("=\"#");
  for (const float value : colour) {
    const auto byte = static_cast<unsigned>(std::lround(value * 255.0F));
    text += digits[byte >> 4U];
    text += digits[byte & 15U];
  }
  text += '"';
}

void append_mark(std::string& text, const Mark& mark) {
  if (mark.from == mark.to && !mark.flat_ends) {
    text += "<circle";
    append_attribute(text, "cx", mark.from.x());
    append_attribute(text, "cy", mark.from.y());
    append_attribute(text, "r", mark.from_width / 2);
    append_colour(text, "fill", mark.colour);
  } else {
    text += "<line";
    append_attribute(text, "x1", mark.from.x());
    append_attribute(text, "y1", mark.from.y());
    append_attribute(text, "x2", mark.to.x());
    append_attribute(text, "y2", mark.to.y());
    append_attribute(text, "stroke-width", (mark.from_width + mark.to_width) / 2);
    append_colour(text, "stroke", mark.colour);
    if (!mark.flat_ends) text += " stroke-linecap=\"round\"";
  }
  text += "/>\n";
}

}  // namespace

std::string png_picture(const CurveSkeleton& skeleton, const Surface& surface,
                        const PictureOptions& options) {
  const std::array<View, 2> views = best_views(surface, options.width, options.height, options.up);
  Image image = picture_of(surface, views, options);
  for (const View& view : views) {
    draw_marks(marks_of(skeleton, view, width_unit(options)), image);
  }
  return png_from(image, options.threads);
}

std::string svg_picture(const CurveSkeleton& skeleton, const Surface& surface,
                        const PictureOptions& options) {
  const std::array<View, 2> views = best_views(surface, options.width, options.height, options.up);
  const std::string width = std::to_string(options.width);
  const std::string height = std::to_string(options.height);
  std::string text =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"" +
      width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height + "\">\n";
  text += "<image width=\"" + width + "\" height=\"" + height +
          "\" xlink:href=\"data:image/png;base64," +
          base64_of(png_from(picture_of(surface, views, options), options.threads)) + "\"/>\n";
  for (const View& view : views) {
    text += "<g fill=\"none\">\n";
    for (const Mark& mark : marks_of(skeleton, view, width_unit(options))) append_mark(text, mark);
    text += "</g>\n";
  }
  return text + "</svg>\n";
}

}  // namespace curveskel
