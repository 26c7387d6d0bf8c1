// usage: PROGRAM [--fast=NAME | --thorough=NAME | --file=NAME] [GoogleTest's options]: all laws,
// those of NAME_test.cpp that users' ./test runs, the rest of them, in suites named "Thorough...",
// or both.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>

namespace {

/// The filter that picks the tests of this file that `option` asks for; empty where there are none.
std::string tests_of(const std::string& file, std::string_view option) {
  std::string filter;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int s = 0; s < program.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *program.GetTestSuite(s);
    const bool thorough = std::string_view(suite.name()).starts_with("Thorough");
    if (option == (thorough ? "--fast=" : "--thorough=")) continue;
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
  for (const std::string_view option : {"--fast=", "--thorough=", "--file="}) {
    if (count < 2 || !std::string_view(arguments[1]).starts_with(option)) continue;
    const std::string name(std::string_view(arguments[1]).substr(option.size()));
    const std::string filter = tests_of(name + "_test.cpp", option);
    if (filter.empty()) {
      std::cerr << "no tests of " << name << "_test.cpp in this program\n";
      return 1;
    }
    GTEST_FLAG_SET(filter, filter);
  }
  return RUN_ALL_TESTS();
}
