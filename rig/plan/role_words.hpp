// A role in the words of a style.
#pragma once

#include <string>

#include <curveskel/body_plan.hpp>
#include <curveskel/role_names.hpp>

namespace curveskel {

/// The role itself where the style has no word for it. Precondition: `style` has words for `kind`.
[[nodiscard]] std::string name_of_role(const std::string& role, BodyKind kind, NameStyle style);

/// "right.." of "left..", "..R" of "..L"; any other as it is.
[[nodiscard]] std::string right_role(const std::string& role);

}  // namespace curveskel
