#include "contraction/device/gl_context.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include <curveskel/error.hpp>

namespace curveskel::gl_context_laws {
namespace {

TEST(GlContext, KeepsWhatAVertexBufferIsGiven) {
  std::optional<GlContext> context;
  std::string why;
  try {
    for (std::size_t i = 0; i < egl_device_count() && !context; ++i) {
      try {
        context.emplace(i);
      } catch (const Error& error) {
        why = error.what();
      }
    }
  } catch (const Error& error) {
    why = error.what();
  }
  if (!context) {
    EXPECT_NE(why.find("use the method opencl"), std::string::npos) << why;
    GTEST_SKIP() << "no OpenGL without a window here: " << why;
  }
  const std::vector<float> first{1, 2, 3, 4};
  const std::vector<float> second{5, 6};
  const std::uint32_t a = context->vertex_buffer(first.data(), 4 * sizeof(float));
  const std::uint32_t b = context->vertex_buffer(second.data(), 2 * sizeof(float));
  context->finish();
  EXPECT_NE(a, b);
  std::vector<float> found(4);
  context->read(a, found.data(), 4 * sizeof(float));
  EXPECT_EQ(found, first);
  EXPECT_NE(context->context(), nullptr);
  EXPECT_NE(context->display(), nullptr);
}

}  // namespace
}  // namespace curveskel::gl_context_laws
