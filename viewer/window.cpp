#include "viewer/window.hpp"
namespace curveskel::viewer {
int run_window(const ViewOptions&, Session&) { return 0; }
}  // namespace curveskel::viewer
