#include "surface/read/dae_document.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <system_error>

namespace curveskel {
namespace {

bool is_xml_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Calls `take(word)` for each word.
template <typename Take>
void for_words(std::string_view text, const Take& take) {
  for (std::size_t at = 0; at < text.size();) {
    if (is_xml_blank(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && !is_xml_blank(text[end])) ++end;
    take(text.substr(at, end - at));
    at = end;
  }
}

/// Some exporters write the decimal comma of the country that they run in.
std::optional<double> number_in(std::string_view word) {
  std::string with_point;
  if (const std::size_t comma = word.find(','); comma != std::string_view::npos) {
    with_point = word;
    with_point[comma] = '.';
    word = with_point;
  }
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [next, error] = fast_float::from_chars(word.data(), end, value);
  return error == std::errc() && next == end ? std::optional(value) : std::nullopt;
}

/// A whole number from 0 on; `otherwise` where the text is none.
std::size_t whole_number(std::string_view text, std::size_t otherwise) {
  std::size_t value = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && next == text.data() + text.size() ? value : otherwise;
}

}  // namespace

DaeDocument::DaeDocument(const FileBytes& file, const XmlElement& root) : file_(file), root_(root) {
  note_ids(root);
}

void DaeDocument::note_ids(const XmlElement& element) {
  const std::string_view id = element.attribute("id");
  if (!id.empty()) by_id_.emplace(id, &element);
  for (const XmlElement& child : element.children) note_ids(child);
}

const XmlElement& DaeDocument::referred(const XmlElement& from, std::string_view key) const {
  const std::string_view url = from.attribute(key);
  if (!url.starts_with('#')) {
    fail(from, "the " + std::string(key) + " " + in_quotes(url) + " of <" + from.name + ">",
         "\"#\" and the id of an element of this file");
  }
  const XmlElement* found = find(url.substr(1));
  if (found == nullptr) fail(from, "no element with the id " + in_quotes(url.substr(1)), "one");
  return *found;
}

const XmlElement* DaeDocument::find(std::string_view id) const {
  const auto found = by_id_.find(std::string(id));
  return found == by_id_.end() ? nullptr : found->second;
}

std::size_t DaeDocument::width(const XmlElement& source) const {
  const XmlElement* common = source.child("technique_common");
  const XmlElement* accessor = common == nullptr ? nullptr : common->child("accessor");
  return accessor == nullptr ? 0 : whole_number(accessor->attribute("stride", "1"), 0);
}

DaeInput DaeDocument::input(const XmlElement& of, std::string_view semantic) const {
  const std::vector<DaeInput> all = inputs(of, semantic);
  return all.empty() ? DaeInput() : all.front();
}

std::vector<DaeInput> DaeDocument::inputs(const XmlElement& of, std::string_view semantic) const {
  std::vector<DaeInput> all;
  for (const XmlElement* input : of.all("input")) {
    if (input->attribute("semantic") != semantic) continue;
    all.push_back({&referred(*input, "source"), whole_number(input->attribute("offset"), 0),
                   whole_number(input->attribute("set"), 0)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const DaeInput& a, const DaeInput& b) { return a.set < b.set; });
  return all;
}

std::size_t DaeDocument::indices_per_corner(const XmlElement& of) const {
  constexpr std::size_t most = 1000;  // no file has more, and a product with it stays small
  std::size_t largest = 0;
  for (const XmlElement* input : of.all("input")) {
    const std::size_t offset = whole_number(input->attribute("offset", "0"), most);
    if (offset >= most) {
      fail(*input, "the offset " + in_quotes(input->attribute("offset")),
           "a whole number below " + std::to_string(most));
    }
    largest = std::max(largest, offset);
  }
  return largest + 1;
}

std::vector<double> DaeDocument::rows(const XmlElement& source, std::size_t width) const {
  const XmlElement* common = source.child("technique_common");
  const XmlElement* accessor = common == nullptr ? nullptr : common->child("accessor");
  const XmlElement* array = accessor == nullptr || !accessor->attribute("source").starts_with('#')
                                ? source.child("float_array")
                                : &referred(*accessor, "source");
  if (array == nullptr || array->name != "float_array") {
    fail(source, "a source without <float_array>", "one");
  }
  std::vector<double> all = numbers(*array);
  if (accessor == nullptr) {
    if (all.size() % width != 0)
      fail(*array, std::to_string(all.size()) + " numbers", "whole rows");
    return all;
  }
  const std::size_t stride = whole_number(accessor->attribute("stride", "1"), 0);
  const std::size_t offset = whole_number(accessor->attribute("offset", "0"), all.size() + 1);
  if (stride < width || offset > all.size()) {
    fail(*accessor, "a stride of " + in_quotes(accessor->attribute("stride", "1")),
         "at least " + std::to_string(width) + " numbers for each row");
  }
  const std::size_t count =
      whole_number(accessor->attribute("count"), (all.size() - offset) / stride);
  // The last row may end with its last value, before the stride does.
  if (count > 0 &&
      (count - 1 > all.size() / stride || offset + (count - 1) * stride + width > all.size())) {
    fail(*accessor, std::to_string(count) + " rows", "no more than the array has");
  }
  std::vector<double> result;
  result.reserve(count * width);
  for (std::size_t row = 0; row < count; ++row) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(offset + row * stride);
    result.insert(result.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
  }
  return result;
}

std::vector<std::string> DaeDocument::names(const XmlElement& source, std::string_view of,
                                            bool& are_ids) const {
  const XmlElement* array = source.child("Name_array");
  are_ids = array == nullptr;
  if (array == nullptr) array = source.child("IDREF_array");
  if (array == nullptr) {
    fail(source, "a source of " + std::string(of) + " without <Name_array>", "one");
  }
  std::vector<std::string> result;
  for_words(array->text, [&](std::string_view word) { result.emplace_back(word); });
  return result;
}

std::vector<double> DaeDocument::numbers(const XmlElement& of) const {
  std::vector<double> result;
  result.reserve(of.text.size() / 8);
  for_words(of.text, [&](std::string_view word) {
    const auto value = number_in(word);
    if (!value) fail(of, in_quotes(word) + " in <" + of.name + ">", "a number");
    result.push_back(*value);
  });
  return result;
}

std::vector<std::size_t> DaeDocument::indices(const XmlElement& of, std::size_t end) const {
  std::vector<std::size_t> result;
  result.reserve(of.text.size() / 4);
  for_words(of.text, [&](std::string_view word) {
    const std::size_t value = whole_number(word, end);
    if (value >= end) {
      fail(of, in_quotes(word) + " in <" + of.name + ">",
           "a whole number from 0 to " + std::to_string(end) + " - 1");
    }
    result.push_back(value);
  });
  return result;
}

Eigen::Affine3d DaeDocument::matrix(const XmlElement& of, const double* numbers) const {
  Eigen::Affine3d result;
  result.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers);
  // Exporters leave some 1e-8 in the last row.
  constexpr double negligible = 1e-6;
  const bool affine = (result.matrix().row(3) - Eigen::RowVector4d::UnitW()).norm() <= negligible;
  if (!affine || !result.matrix().allFinite()) {
    fail(of, "a matrix that is not affine", "finite numbers and a last row of 0 0 0 1");
  }
  result.makeAffine();
  return result;
}

}  // namespace curveskel
