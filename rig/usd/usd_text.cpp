#include "rig/usd/usd_text.hpp"

#include <array>
#include <cmath>

#include "base/decimal.hpp"
#include "base/utf8.hpp"

namespace curveskel {
namespace {

void append_single(std::string& text, double number) {
  const float single = static_cast<float>(number) + 0.0F;  // no -0
  append_decimal(text, std::isfinite(single) ? single : 0.0F);
}

void append_rows_of(std::string& text, const std::vector<double>& rows, std::size_t width) {
  text += '[';
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t column = k % width;
    if (k > 0) text += column == 0 && width > 1 ? "), (" : ", ";
    if (k == 0 && width > 1) text += '(';
    append_single(text, rows[k]);
  }
  text += rows.empty() || width == 1 ? "]" : ")]";
}

void append_tuple(std::string& text, const std::vector<double>& numbers) {
  if (numbers.size() > 1) text += '(';
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (k > 0) text += ", ";
    append_single(text, numbers[k]);
  }
  if (numbers.size() > 1) text += ')';
}

template <typename Items, typename Append>
void append_usd_list(std::string& text, const Items& items, const Append& append) {
  text += '[';
  bool first = true;
  for (const auto& item : items) {
    if (!first) text += ", ";
    first = false;
    append(item);
  }
  text += ']';
}

}  // namespace

std::string usd_quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : as_utf8(text)) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else {
      result += code < ' ' || code == 127 ? '_' : c;
    }
  }
  return result + "\"";
}

std::string usd_target(const std::string& path) { return "<" + path + ">"; }

std::string usd_tuple(const std::vector<double>& numbers) {
  std::string text;
  append_tuple(text, numbers);
  return text;
}

std::string usd_matrix(const Eigen::Affine3d& frame) {
  const Eigen::Matrix4d rows = frame.matrix().transpose();
  std::string text = "(";
  for (int i = 0; i < 4; ++i) {
    text += i == 0 ? "(" : ", (";
    for (int j = 0; j < 4; ++j) {
      if (j > 0) text += ", ";
      append_decimal(text, std::isfinite(rows(i, j)) ? rows(i, j) + 0.0 : 0.0);
    }
    text += ')';
  }
  return text + ")";
}

void UsdText::begin(const char* type, const std::string& name, const UsdPrim& prim) {
  indent();
  text_ += "def ";
  text_ += type;
  text_ += " \"" + name + "\"";
  std::vector<std::string> about;
  if (!prim.schemas.empty()) {
    std::string list = "prepend apiSchemas = ";
    append_usd_list(list, prim.schemas, [&](const char* schema) {
      list += '"';
      list += schema;
      list += '"';
    });
    about.push_back(std::move(list));
  }
  if (!prim.true_name.empty()) about.push_back("displayName = " + usd_quoted(prim.true_name));
  if (*prim.kind != '\0') about.push_back("kind = \"" + std::string(prim.kind) + "\"");
  if (!about.empty()) {
    text_ += " (\n";
    ++depth_;
    for (const std::string& one : about) line(one);
    --depth_;
    indent();
    text_ += ')';
  }
  text_ += '\n';
  line("{");
  ++depth_;
}

void UsdText::end() {
  --depth_;
  line("}");
}

void UsdText::line(std::string_view text) {
  indent();
  text_ += text;
  text_ += '\n';
}

void UsdText::end_attribute(const UsdAttribute& attribute) {
  const bool is_bare = *attribute.interpolation == '\0' && attribute.element_size == 0;
  if (!is_bare) {
    text_ += " (\n";
    ++depth_;
    if (attribute.element_size > 0) {
      line("elementSize = " + std::to_string(attribute.element_size));
    }
    if (*attribute.interpolation != '\0') {
      line("interpolation = \"" + std::string(attribute.interpolation) + "\"");
    }
    --depth_;
    indent();
    text_ += ')';
  }
  text_ += '\n';
}

void UsdText::numbers(std::string_view head, const std::vector<double>& rows, std::size_t width,
                      const UsdAttribute& attribute) {
  indent();
  text_.append(head).append(" = ");
  append_rows_of(text_, rows, width);
  end_attribute(attribute);
}

void UsdText::integers(std::string_view head, const std::vector<std::int32_t>& numbers,
                       const UsdAttribute& attribute) {
  indent();
  text_.append(head).append(" = ");
  append_usd_list(text_, numbers, [&](std::int32_t number) { append_decimal(text_, number); });
  end_attribute(attribute);
}

void UsdText::words(std::string_view head, const std::vector<std::string>& words) {
  indent();
  text_.append(head).append(" = ");
  append_usd_list(text_, words, [&](const std::string& word) { text_ += usd_quoted(word); });
  text_ += '\n';
}

void UsdText::matrices(std::string_view head, const std::vector<Eigen::Affine3d>& frames) {
  indent();
  text_.append(head).append(" = ");
  append_usd_list(text_, frames, [&](const Eigen::Affine3d& frame) { text_ += usd_matrix(frame); });
  text_ += '\n';
}

void UsdText::samples(const std::string& head, const std::vector<double>& time_codes,
                      const std::vector<std::vector<double>>& samples, std::size_t width,
                      bool is_array) {
  const auto append_value = [&](const std::vector<double>& rows) {
    if (is_array) {
      append_rows_of(text_, rows, width);
    } else {
      append_tuple(text_, rows);
    }
  };
  indent();
  if (time_codes.empty()) {
    text_.append(head).append(" = ");
    append_value(samples.front());
    text_ += '\n';
    return;
  }
  text_.append(head).append(".timeSamples = {\n");
  ++depth_;
  for (std::size_t k = 0; k < time_codes.size(); ++k) {
    indent();
    append_decimal(text_, time_codes[k]);
    text_ += ": ";
    append_value(samples[k]);
    text_ += ",\n";
  }
  --depth_;
  line("}");
}

}  // namespace curveskel
