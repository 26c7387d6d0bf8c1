// The paper's method with transfers: every iteration ends with the positions on the host and begins
// with them copied to the device.
#include <utility>

#include "contraction/fairing/local_flow.hpp"

namespace curveskel {
namespace {

class TransferFlow final : public LocalFlow {
 public:
  explicit TransferFlow(std::unique_ptr<LocalFlow> resident) : resident_(std::move(resident)) {}

  void advance(int iterations, const Monitor& monitor) override {
    for (int iteration = 0; iteration < iterations; ++iteration) {
      resident_->advance(1, of_one_iteration(monitor, iteration, iterations));
      resident_->copy_through_host();
    }
  }

  Positions positions() override { return resident_->positions(); }

 private:
  std::unique_ptr<LocalFlow> resident_;
};

}  // namespace

std::unique_ptr<LocalFlow> make_transfer_flow(std::unique_ptr<LocalFlow> resident) {
  return std::make_unique<TransferFlow>(std::move(resident));
}

}  // namespace curveskel
