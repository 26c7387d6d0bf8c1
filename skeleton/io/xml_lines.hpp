// XML that is written line by line.
#pragma once

#include <cstddef>
#include <pugixml.hpp>
#include <string>
#include <utility>

#include "base/one_line.hpp"

namespace curveskel {

/// A document that keeps the lines that it is given: pugixml escapes, and leaves blanks alone.
class XmlLines {
 public:
  explicit XmlLines(const std::string& provenance) {
    pugi::xml_node head = document.append_child(pugi::node_declaration);
    head.append_attribute("version") = "1.0";
    head.append_attribute("encoding") = "UTF-8";
    end_line(document);
    if (provenance.empty()) return;
    const std::string text = " " + in_one_line(provenance) + " ";
    document.append_child(pugi::node_comment).set_value(text.c_str());
    end_line(document);
  }

  static void end_line(pugi::xml_node in) { in.append_child(pugi::node_pcdata).set_value("\n"); }

  /// An element whose content begins on a line of its own.
  static pugi::xml_node open(pugi::xml_node in, const char* name) {
    pugi::xml_node element = in.append_child(name);
    end_line(element);
    return element;
  }

  [[nodiscard]] std::string text() const {
    struct Appender : pugi::xml_writer {
      std::string bytes;
      void write(const void* data, std::size_t size) override {
        bytes.append(static_cast<const char*>(data), size);
      }
    } appender;
    document.save(appender, "", pugi::format_raw, pugi::encoding_utf8);
    return std::move(appender.bytes);
  }

  pugi::xml_document document;
};

/// A DataArray with one line per call of `append_row(text, row)`.
template <typename AppendRow>
pugi::xml_node append_array(pugi::xml_node in, const char* type, const char* name, int components,
                            std::size_t rows, const AppendRow& append_row) {
  pugi::xml_node array = in.append_child("DataArray");
  array.append_attribute("type") = type;
  array.append_attribute("Name") = name;
  if (components > 1) array.append_attribute("NumberOfComponents") = components;
  array.append_attribute("format") = "ascii";
  std::string text = "\n";
  for (std::size_t row = 0; row < rows; ++row) {
    append_row(text, row);
    text += '\n';
  }
  array.text().set(text.c_str());
  XmlLines::end_line(in);
  return array;
}

/// The elements of a VTK PolyData file, from the outermost to the piece that holds all.
struct PolyDataElements {
  pugi::xml_node file;
  pugi::xml_node body;
  pugi::xml_node piece;
};

struct PolyDataCounts {
  std::size_t points = 0;
  std::size_t verts = 0;
  std::size_t lines = 0;
  std::size_t polys = 0;
};

[[nodiscard]] inline PolyDataElements open_poly_data(XmlLines& xml, const PolyDataCounts& counts) {
  PolyDataElements elements;
  elements.file = XmlLines::open(xml.document, "VTKFile");
  elements.file.append_attribute("type") = "PolyData";
  elements.file.append_attribute("version") = "1.0";
  elements.file.append_attribute("byte_order") = "LittleEndian";
  elements.file.append_attribute("header_type") = "UInt64";
  elements.body = XmlLines::open(elements.file, "PolyData");
  elements.piece = XmlLines::open(elements.body, "Piece");
  elements.piece.append_attribute("NumberOfPoints") = counts.points;
  elements.piece.append_attribute("NumberOfVerts") = counts.verts;
  elements.piece.append_attribute("NumberOfLines") = counts.lines;
  elements.piece.append_attribute("NumberOfStrips") = 0;
  elements.piece.append_attribute("NumberOfPolys") = counts.polys;
  return elements;
}

inline void close_poly_data(XmlLines& xml, const PolyDataElements& elements) {
  for (pugi::xml_node parent : {elements.body, elements.file, pugi::xml_node(xml.document)}) {
    XmlLines::end_line(parent);
  }
}

}  // namespace curveskel
