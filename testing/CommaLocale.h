/// @file CommaLocale.h
/// @brief For the tests: a locale that writes 1.234,5 for 1234.5.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <locale>
#include <string>

namespace hybrid_slam::test {

/// Sets the program's C and C++ locale for its lifetime. Compiles the locale itself: German is not installed
/// everywhere.
class CommaLocale {
 public:
  CommaLocale() : folder_(std::filesystem::temp_directory_path() / "hybrid-slam-locale-XXXXXX") {
    folder_ = ::mkdtemp(folder_.string().data());
    std::ofstream(folder_ / "source") << "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\n"
                                         "grouping 3;3\nEND LC_NUMERIC\n";
    // It warns about missing categories.
    const std::string command = "localedef -c -i '" + (folder_ / "source").string() + "' '" +
                                (folder_ / "xx_XX").string() + "' >/dev/null 2>&1 || true";
    if (std::system(command.c_str()) != 0) std::abort();
    ::setenv("LOCPATH", folder_.c_str(), 1);
    before_ = std::locale::global(std::locale("xx_XX"));
  }
  ~CommaLocale() {
    std::locale::global(before_);
    ::unsetenv("LOCPATH");
    std::filesystem::remove_all(folder_);
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

 private:
  std::filesystem::path folder_;
  std::locale before_;
};

}  // namespace hybrid_slam::test
