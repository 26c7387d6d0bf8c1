#include "skeleton/io/xml.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

namespace curveskel {
namespace {

constexpr int deepest_element = 64;
constexpr std::string_view blanks = " \t\r\n";

std::string without_prefix(std::string_view name) {
  const std::size_t colon = name.find(':');
  return std::string(colon == std::string_view::npos ? name : name.substr(colon + 1));
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto append = [&text](std::uint32_t byte) {
    text += static_cast<char>(static_cast<unsigned char>(byte));
  };
  if (code < 0x80) return append(code);
  if (code < 0x800) {
    append(0xC0U | code >> 6U);
  } else if (code < 0x10000) {
    append(0xE0U | code >> 12U);
    append(0x80U | (code >> 6U & 0x3FU));
  } else {
    append(0xF0U | code >> 18U);
    append(0x80U | (code >> 12U & 0x3FU));
    append(0x80U | (code >> 6U & 0x3FU));
  }
  append(0x80U | (code & 0x3FU));
}

class Parser {
 public:
  explicit Parser(const FileBytes& file) : file_(file), text_(file.content) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  XmlElement document() {
    skip_between_elements();
    if (at_ == text_.size()) fail("the end of the file", "an element");
    if (text_[at_] != '<') fail(in_quotes(text_.substr(at_, 20)), "an element");
    XmlElement root = element(0);
    skip_between_elements();
    if (at_ != text_.size()) {
      fail(in_quotes(text_.substr(at_, 20)), "nothing behind the last element");
    }
    return root;
  }

 private:
  [[noreturn]] void fail(std::string_view found, std::string_view needed) const {
    fail_at(file_, at_, found, needed);
  }

  bool accept(std::string_view token) {
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }

  /// The text before the token; the token is stepped over, too.
  std::string_view until(std::string_view token) {
    const std::size_t end = text_.find(token, at_);
    if (end == std::string_view::npos) {
      fail("no " + in_quotes(token) + " before the end of the file", "one");
    }
    const std::string_view before = text_.substr(at_, end - at_);
    at_ = end + token.size();
    return before;
  }

  void skip_blanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }

  void skip_between_elements() {
    for (;;) {
      skip_blanks();
      if (accept("<?")) {
        until("?>");
      } else if (accept("<!--")) {
        until("-->");
      } else if (accept("<!DOCTYPE")) {
        skip_doctype();
      } else {
        return;
      }
    }
  }

  /// To its '>', past an internal subset in brackets.
  void skip_doctype() {
    int brackets = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      brackets += c == '[' ? 1 : c == ']' ? -1 : 0;
      if (c == '>' && brackets <= 0) break;
    }
    until(">");
  }

  std::string_view name() {
    constexpr std::string_view ends = " \t\r\n/>=<\"'";
    const std::size_t end = std::min(text_.find_first_of(ends, at_), text_.size());
    if (end == at_) fail(in_quotes(text_.substr(at_, 20)), "a name");
    const std::string_view found = text_.substr(at_, end - at_);
    at_ = end;
    return found;
  }

  XmlElement element(int depth) {
    if (depth > deepest_element) {
      fail("elements nested more than " + std::to_string(deepest_element) + " deep", "fewer");
    }
    XmlElement result;
    result.position = at_;
    accept("<");
    const std::string_view tag = name();
    result.name = without_prefix(tag);
    for (skip_blanks(); !accept(">"); skip_blanks()) {
      if (accept("/>")) return result;
      result.attributes.push_back(attribute());
    }
    if (result.name == "AppendedData" && result.attribute("encoding") == "raw") {
      const std::size_t end = text_.rfind("</" + std::string(tag));
      if (end == std::string_view::npos || end < at_) fail("no end of the data", "</AppendedData>");
      result.text = text_.substr(at_, end - at_);
      at_ = end;
    }
    content(result, depth);
    const std::string_view closing = name();
    if (closing != tag) {
      fail("</" + std::string(closing) + ">", "</" + std::string(tag) + ">");
    }
    skip_blanks();
    if (!accept(">")) fail(in_quotes(text_.substr(at_, 20)), ">");
    return result;
  }

  std::pair<std::string, std::string> attribute() {
    const std::string_view key = name();
    skip_blanks();
    if (!accept("=")) fail("the attribute " + in_quotes(key) + " without a value", "=\"...\"");
    skip_blanks();
    std::string value;
    if (accept("\"")) {
      append_resolved(value, until("\""));
    } else if (accept("'")) {
      append_resolved(value, until("'"));
    } else {
      fail("the attribute " + in_quotes(key) + " without quotes", "=\"...\"");
    }
    return {std::string(key), std::move(value)};
  }

  /// Up to and with the "</" of the element's own end tag.
  void content(XmlElement& element_of, int depth) {
    for (;;) {
      const std::size_t tag = text_.find('<', at_);
      if (tag == std::string_view::npos) {
        fail("no end tag before the end of the file", "</" + element_of.name + ">");
      }
      append_resolved(element_of.text, text_.substr(at_, tag - at_));
      at_ = tag;
      if (accept("</")) return;
      if (accept("<!--")) {
        until("-->");
      } else if (accept("<![CDATA[")) {
        element_of.text += until("]]>");
      } else if (accept("<?")) {
        until("?>");
      } else {
        element_of.children.push_back(element(depth + 1));
      }
    }
  }

  void append_resolved(std::string& result, std::string_view raw) const {
    constexpr std::array<std::pair<std::string_view, char>, 5> entities{
        {{"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}}};
    for (std::size_t i = raw.find('&'); i != std::string_view::npos; i = raw.find('&')) {
      result += raw.substr(0, i);
      const std::size_t end = raw.find(';', i);
      if (end == std::string_view::npos) fail("an '&' without ';'", "&amp;");
      const std::string_view entity = raw.substr(i + 1, end - i - 1);
      const auto* known = std::find_if(entities.begin(), entities.end(),
                                       [&](const auto& e) { return e.first == entity; });
      if (known != entities.end()) {
        result += known->second;
      } else {
        append_utf8(result, character(entity));
      }
      raw.remove_prefix(end + 1);
    }
    result += raw;
  }

  [[nodiscard]] std::uint32_t character(std::string_view entity) const {
    constexpr std::uint32_t last_code = 0x10FFFF;
    const bool hexadecimal = entity.starts_with("#x");
    const std::string_view digits =
        entity.substr(std::min<std::size_t>(entity.size(), hexadecimal ? 2 : 1));
    std::uint32_t code = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), code, hexadecimal ? 16 : 10);
    if (!entity.starts_with('#') || error != std::errc() || end != digits.data() + digits.size() ||
        code > last_code) {
      fail(in_quotes(entity) + " after an &", "a character reference or a known entity");
    }
    return code;
  }

  const FileBytes& file_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::string_view XmlElement::attribute(std::string_view key, std::string_view otherwise) const {
  for (const auto& [name_of, value] : attributes) {
    if (name_of == key) return value;
  }
  return otherwise;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  for (const XmlElement& element : children) {
    if (element.name == child_name) return &element;
  }
  return nullptr;
}

std::vector<const XmlElement*> XmlElement::all(std::string_view child_name) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement& element : children) {
    if (element.name == child_name) found.push_back(&element);
  }
  return found;
}

XmlElement parse_xml(const FileBytes& file) { return Parser(file).document(); }

void fail_at(const FileBytes& file, std::size_t position, std::string_view found,
             std::string_view needed) {
  const std::string_view before = std::string_view(file.content).substr(0, position);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  throw Error(Fault::input, file.path.string() + ", line " + std::to_string(line) + ": found " +
                                std::string(found) + ", needed " + std::string(needed) +
                                "; correct it or export the file again");
}

}  // namespace curveskel
