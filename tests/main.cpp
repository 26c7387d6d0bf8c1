// usage: PROGRAM [--file=NAME] [GoogleTest's options]: all laws, or those of NAME_test.cpp.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>

namespace {

/// The filter that picks the tests of this file; empty where there are none.
std::string tests_of(const std::string& file) {
  std::string filter;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int s = 0; s < program.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *program.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      if (std::filesystem::path(test.file()).filename() != file) continue;
      filter.append(filter.empty() ? "" : ":").append(suite.name()).append(".").append(test.name());
    }
  }
  return filter;
}

}  // namespace

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  constexpr std::string_view option = "--file=";
  if (count > 1 && std::string_view(arguments[1]).starts_with(option)) {
    const std::string name(std::string_view(arguments[1]).substr(option.size()));
    const std::string filter = tests_of(name + "_test.cpp");
    if (filter.empty()) {
      std::cerr << "no tests of " << name << "_test.cpp in this program\n";
      return 1;
    }
    GTEST_FLAG_SET(filter, filter);
  }
  return RUN_ALL_TESTS();
}
