#include <curveskel/advanced/device.hpp>

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <curveskel/error.hpp>
#include <curveskel/fair.hpp>
#include "contraction/device/opencl.hpp"
#include "contraction/device/program_cache.hpp"

namespace curveskel::device_laws {
namespace {

namespace fs = std::filesystem;

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

/// A folder of its own, gone afterwards.
class ProgramCache : public testing::Test {
 protected:
  void SetUp() override {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("curveskel-" + std::string(test->name()) + "-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path only_file() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_)) files.push_back(entry.path());
    EXPECT_EQ(files.size(), 1U);
    return files.empty() ? fs::path() : files.front();
  }
  void write(const std::string& bytes) const {
    std::ofstream(only_file(), std::ios::binary) << bytes;
  }
  [[nodiscard]] std::string read() const {
    std::ifstream in(only_file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_;
};

std::vector<unsigned char> some_binary() {
  std::vector<unsigned char> binary(300);
  for (std::size_t i = 0; i < binary.size(); ++i) binary[i] = static_cast<unsigned char>(7 * i);
  return binary;
}

TEST_F(ProgramCache, GivesBackWhatWasKeptForThisKeyAlone) {
  EXPECT_TRUE(opencl::cached_binary(folder_, "key").empty());
  opencl::keep_binary(folder_, "key", some_binary());
  EXPECT_EQ(opencl::cached_binary(folder_, "key"), some_binary());
  EXPECT_TRUE(opencl::cached_binary(folder_, "another key").empty());
  const std::vector<unsigned char> shorter(3, 10);
  opencl::keep_binary(folder_, "key", shorter);
  EXPECT_EQ(opencl::cached_binary(folder_, "key"), shorter);
}

TEST_F(ProgramCache, NeverGivesADamagedBinary) {
  opencl::keep_binary(folder_, "key\nof two lines", some_binary());
  const std::string whole = read();
  const auto expect_refused = [&](const std::string& bytes, std::size_t at) {
    opencl::keep_binary(folder_, "key\nof two lines", some_binary());
    write(bytes);
    EXPECT_TRUE(opencl::cached_binary(folder_, "key\nof two lines").empty()) << at;
    EXPECT_TRUE(fs::is_empty(folder_)) << at;
  };
  for (std::size_t at = 0; at < whole.size(); ++at) {
    expect_refused(whole.substr(0, at), at);
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 16);
    expect_refused(flipped, at);
  }
  expect_refused(whole + '\0', whole.size());
}

TEST_F(ProgramCache, ADamagedFileIsCompiledAnewAndReplaced) {
  if (devices().empty()) GTEST_SKIP() << "no OpenCL device on this machine";
  constexpr std::string_view source =
      "__kernel void one(__global int* x) { x[get_global_id(0)] = 1; }";
  const opencl::Session session(0);
  (void)session.build(source, "", folder_);
  const std::string whole = read();
  write(whole.substr(0, whole.size() / 2));
  (void)session.build(source, "", folder_).kernel("one");
  EXPECT_GT(read().size(), whole.size() / 2);
  EXPECT_NO_THROW((void)session.build(source, "", folder_).kernel("one"));
}

}  // namespace
}  // namespace curveskel::device_laws
