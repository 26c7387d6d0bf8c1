#include <curveskel/advanced/device.hpp>

#include <gtest/gtest.h>

#include <cstdlib>

#include <curveskel/error.hpp>
#include <curveskel/fair.hpp>
#include "contraction/device/opencl.hpp"

namespace curveskel::device_laws {
namespace {

Device named(const std::string& name, bool gpu, bool double_precision, bool gl_sharing) {
  Device device;
  device.name = name;
  device.gpu = gpu;
  device.double_precision = double_precision;
  device.gl_sharing = gl_sharing;
  return device;
}

std::string message_of_choice(const std::vector<Device>& candidates, const DeviceNeeds& needs) {
  try {
    (void)choose_device(candidates, needs, "the method opencl", "use --method cpu");
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::device);
    return error.what();
  }
  return {};
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Devices, EachIsDescribed) {
  for (const Device& device : devices()) {
    EXPECT_FALSE(device.name.empty());
    EXPECT_FALSE(device.platform.empty());
    EXPECT_FALSE(device.driver.empty());
    EXPECT_EQ(device.version.rfind("OpenCL ", 0), 0U) << device.version;
    EXPECT_GT(device.compute_units, 0) << device.name;
    EXPECT_GT(device.memory_bytes, 0U) << device.name;
  }
}

TEST(DevicesDeathTest, WithoutADriverTheListIsEmpty) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("OCL_ICD_VENDORS", "/nonexistent", 1);
        std::exit(devices().empty() ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(ChooseDevice, PrefersTheFirstGpuThatHasWhatIsNeeded) {
  const Device cpu = named("cpu", false, true, false);
  const Device small = named("small", true, false, false);
  const Device large = named("large", true, true, true);
  EXPECT_EQ(choose_device({cpu, small, large}, {}, "", ""), 1U);
  EXPECT_EQ(choose_device({cpu, small, large}, {.double_precision = true}, "", ""), 2U);
  EXPECT_EQ(choose_device({cpu, small, large}, {.gl_sharing = true}, "", ""), 2U);
  EXPECT_EQ(choose_device({small, cpu}, {.double_precision = true}, "", ""), 1U);
}

TEST(ChooseDevice, SaysWhatIsMissingAndWhatToDo) {
  const std::string none = message_of_choice({}, {});
  EXPECT_TRUE(holds(none, "the method opencl")) << none;
  EXPECT_TRUE(holds(none, "none was found")) << none;
  EXPECT_TRUE(holds(none, "use --method cpu")) << none;
  const std::string single =
      message_of_choice({named("Chip 7", true, false, false)}, {.double_precision = true});
  EXPECT_TRUE(holds(single, "cl_khr_fp64")) << single;
  EXPECT_TRUE(holds(single, "Chip 7")) << single;
  const std::string headless =
      message_of_choice({named("Chip 7", true, false, false)}, {.gl_sharing = true});
  EXPECT_TRUE(holds(headless, "cl_khr_gl_sharing")) << headless;
}

TEST(FairMethods, EachNeedsWhatTheDeviceMustHave) {
  using Methods = std::vector<FairMethod>;
  const Methods plain{FairMethod::opencl, FairMethod::opencl_transfer};
  const Methods all{FairMethod::opencl, FairMethod::opencl_transfer, FairMethod::opencl_interop};
  EXPECT_EQ(fair_methods_on(named("single", true, false, false), false), plain);
  EXPECT_EQ(fair_methods_on(named("single", true, false, false), true), Methods());
  EXPECT_EQ(fair_methods_on(named("double", false, true, false), true), plain);
  EXPECT_EQ(fair_methods_on(named("graphics", true, false, true), false), all);
  EXPECT_EQ(fair_methods_on(named("graphics", true, false, true), true), Methods());
  EXPECT_EQ(fair_methods_on(named("both", true, true, true), true), all);
}

TEST(Session, ABrokenKernelIsADeviceFaultWithTheCompilersLog) {
  if (devices().empty()) GTEST_SKIP() << "no OpenCL device on this machine";
  const opencl::Session session(0);
  try {
    (void)session.build("__kernel void broken(__global int* x) { x[0] = no_such_name; }", "", {});
    FAIL() << "it was built";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::device);
    EXPECT_TRUE(holds(error.what(), "no_such_name")) << error.what();
    EXPECT_TRUE(holds(error.what(), session.device().name)) << error.what();
  }
}

}  // namespace
}  // namespace curveskel::device_laws
