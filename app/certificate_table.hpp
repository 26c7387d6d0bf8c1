// The certificate for people.
#pragma once

#include <string>

#include <curveskel/certificate.hpp>

namespace curveskel {

/// A table of a dozen lines, each with its line end.
[[nodiscard]] std::string certificate_table(const Certificate& certificate,
                                            const CertificateOptions& options);

/// All that keeps it from holding, in one line; empty if it holds.
[[nodiscard]] std::string all_failures(const Certificate& certificate,
                                       const CertificateOptions& options);

}  // namespace curveskel
