// Which tries an extraction made, why, and how each ended.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/names.hpp>
#include <curveskel/certificate.hpp>

namespace curveskel {

/// Names of the tries, in the order in which they are made.
inline constexpr std::string_view try_as_asked = "as asked";
inline constexpr std::string_view try_gentler = "gentler contraction";
inline constexpr std::string_view try_level_sets = "level-set graph";
inline constexpr std::string_view try_faired = "faired";
inline constexpr std::string_view try_all_vertices = "all vertices";
inline constexpr std::string_view try_handles_cut = "handles cut";
inline constexpr std::string_view try_wrapped = "wrapped";

enum class Outcome {
  kept,        ///< part of the result
  not_better,  ///< than another one, which was kept
  failed       ///< came to nothing, see Try::message
};

inline constexpr NameTable<Outcome, 3> outcomes{{
    {Outcome::kept, "kept", "part of the result"},
    {Outcome::not_better, "not better", "than another one, which was kept"},
    {Outcome::failed, "failed", "came to nothing"},
}};

/// A certificate in brief.
struct CertificateInBrief {
  bool topology_correct = false;
  bool inside_enough = false;
  double inside_fraction = 0;
  int tips = 0;
  int junctions = 0;
};

[[nodiscard]] CertificateInBrief in_brief(const Certificate& certificate);

/// One try. The surface is tried as a whole, and within each of these tries each component is cut
/// by its own.
struct Try {
  std::string name;    ///< one of the above
  int component = -1;  ///< in `topology`, of the surface that the try is part of; -1 = all of it
  int part_of = -1;    ///< number of the try that this one was made in; -1 = none
  std::string why;     ///< it was made; empty for what is always made
  Outcome outcome = Outcome::failed;
  std::string message;                            ///< why it failed; else empty
  double seconds = 0;                             ///< with those of the tries that are part of it
  std::optional<CertificateInBrief> certificate;  ///< none where it failed, or cut a component
};

/// With the names of the tries that it is part of, as ShownTry has it; empty below 0. Throws
/// Error(Fault::input) for a number beyond the history, and where a try is part of a later one.
[[nodiscard]] std::string full_name(const std::vector<Try>& history, int number);

/// True if a try of this name is part of the result: of any component, or of this one.
[[nodiscard]] bool is_kept(const std::vector<Try>& history, std::string_view name,
                           std::optional<int> component = {});

}  // namespace curveskel
