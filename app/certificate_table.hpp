// The certificate for people.
#pragma once

#include <string>

#include <curveskel/certificate.hpp>

namespace curveskel {

/// A table of a dozen lines, each with its line end.
[[nodiscard]] std::string certificate_table(const Certificate& certificate,
                                            const CertificateOptions& options);

}  // namespace curveskel
