// A COLLADA document: its elements by id, its arrays of numbers. Internal to surface/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "surface/read/file_bytes.hpp"
#include "surface/read/xml.hpp"

namespace curveskel {

/// The input of a mesh, a skin and so on: where values of one kind come from.
struct DaeInput {
  const XmlElement* source = nullptr;
  std::size_t offset = 0;  ///< among the indices of one corner
  std::size_t set = 0;     ///< of several of one semantic
};

/// All questions throw Error(Fault::input) with the line.
class DaeDocument {
 public:
  /// Both must outlive the document.
  DaeDocument(const FileBytes& file, const XmlElement& root);

  [[nodiscard]] const XmlElement& root() const { return root_; }
  [[nodiscard]] bool has(std::string_view id) const { return find(id) != nullptr; }
  /// The element with that id, or nullptr.
  [[nodiscard]] const XmlElement* find(std::string_view id) const;
  /// The element to which an attribute of `from` refers, as "#id".
  [[nodiscard]] const XmlElement& referred(const XmlElement& from, std::string_view key) const;
  /// The input of that semantic among the children of `of`; its source is nullptr if there is none.
  [[nodiscard]] DaeInput input(const XmlElement& of, std::string_view semantic) const;
  /// All inputs of that semantic, by their sets.
  [[nodiscard]] std::vector<DaeInput> inputs(const XmlElement& of, std::string_view semantic) const;
  /// Numbers that the rows of a source have; 0 where it does not say.
  [[nodiscard]] std::size_t width(const XmlElement& source) const;
  /// Indices of one corner: one more than the largest offset.
  [[nodiscard]] std::size_t indices_per_corner(const XmlElement& of) const;

  /// `width` numbers for each row of a source.
  [[nodiscard]] std::vector<double> rows(const XmlElement& source, std::size_t width) const;
  /// The words of a source's array of names or ids; `are_ids` says which. `of`, for messages:
  /// "joints".
  [[nodiscard]] std::vector<std::string> names(const XmlElement& source, std::string_view of,
                                               bool& are_ids) const;
  /// All numbers in the text of an element.
  [[nodiscard]] std::vector<double> numbers(const XmlElement& of) const;
  /// All numbers in the text of an element, each from 0 to `end` - 1.
  [[nodiscard]] std::vector<std::size_t> indices(const XmlElement& of, std::size_t end) const;
  /// Sixteen numbers by rows, which move columns.
  [[nodiscard]] Eigen::Affine3d matrix(const XmlElement& of, const double* numbers) const;

  [[noreturn]] void fail(const XmlElement& at, std::string_view found,
                         std::string_view needed) const {
    fail_at(file_, at.position, found, needed);
  }

 private:
  void note_ids(const XmlElement& element);
  const FileBytes& file_;
  const XmlElement& root_;
  std::unordered_map<std::string, const XmlElement*> by_id_;
};

}  // namespace curveskel
