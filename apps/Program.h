/// @file Program.h
/// @brief Shared by all programs: the command line, one-line errors and exit codes.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/Errors.h"
#include "base/Options.h"
#include "base/Terminal.h"
#include "files/InstalledFiles.h"
#include "files/PartialFile.h"

namespace hybrid_slam {

/// Prints the error on one line of standard error, even if it quotes text with line breaks. CMake defines
/// HYBRID_SLAM_PROGRAM, the program's name.
/// @return the exit code
inline int fail(int code, const std::string& message) {
  std::cerr << HYBRID_SLAM_PROGRAM ": error: " << files::withInstalledPages(onOneLine(message)) << "\n";
  return code;
}

/// Prints warnings on standard error, one per line.
inline void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    std::cerr << HYBRID_SLAM_PROGRAM ": warning: " << files::withInstalledPages(onOneLine(warning)) << "\n";
}

/// Opens closed standard descriptors on /dev/null: otherwise a result file would get their number, and
/// messages.
inline void openStandardDescriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0) (void)!::open("/dev/null", O_RDWR);  // the lowest number free
}

/// Makes a closed pipe, a server or a device that hangs up, and a limit of the file size end a write with an
/// error, not the program.
inline void keepWriteErrors() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

/// Ends the program with its error line where an exception, such as that of lacking memory, cannot be caught.
inline void endWithAnErrorLine() {
  std::set_terminate([] {
    constexpr char kLine[] =
        HYBRID_SLAM_PROGRAM ": error: run failed: out of memory, or an error in a thread\n";
    (void)!::write(STDERR_FILENO, kLine, sizeof kLine - 1);
    ::_exit(1);
  });
}

/// Returns whether standard output is a terminal.
inline bool isTerminal() { return ::isatty(STDOUT_FILENO) == 1; }

/// Returns whether everything printed has reached standard output.
inline bool isPrinted() {
  std::cout.flush();
  return std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout.good();
}

/// Returns "the nearest option is `--particles`; ..." for the first unknown option that resembles a known
/// one.
inline std::string nearestOption(const CLI::App& app) {
  std::vector<std::string> names;
  const auto addNames = [&names](const CLI::App& of) {
    for (const CLI::Option* option : of.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  };
  addNames(app);
  for (const CLI::App* command : app.get_subcommands()) addNames(*command);
  for (const std::string& given : app.remaining(true)) {
    const std::string name = given.substr(0, given.find('=')), nearest = nearestName(name, names);
    if (name.rfind("--", 0) == 0 && 3 * editDistance(name, nearest) <= name.size())
      return "the nearest option is `" + nearest + "`, ";
  }
  return {};
}

/// Adds -q.
inline void addQuiet(CLI::App& app, bool& isQuiet) {
  app.add_flag("-q,--quiet", isQuiet, "print neither progress nor a summary");
}

/// Prints options in lines of at most 100 characters.
class WrappedHelp : public CLI::Formatter {
 public:
  std::string make_option_desc(const CLI::Option* option) const override {
    constexpr size_t kWidth = 100;
    std::string text;
    for (const std::string& line :
         wrapped(CLI::Formatter::make_option_desc(option), kWidth - get_column_width()))
      text += (text.empty() ? "" : "\n") + line;
    return text;
  }
};

/// Reads the command line.
/// @return the exit code if the program ends here (--help, --version)
/// @throws InputError for a wrong command line
inline std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  const auto help = std::make_shared<WrappedHelp>();
  app.formatter(help);
  for (CLI::App* command : app.get_subcommands({})) command->formatter(help);
  try {
    app.parse(argc, argv);
    return {};
  } catch (const CLI::Success& request) {
    std::ostringstream out;
    const int code = app.exit(request, out);
    std::cout << files::withInstalledPages(out.str());
    return code;
  } catch (const CLI::ExtrasError& error) {
    throw InputError(error.what(), "command line", nearestOption(app) + "see " HYBRID_SLAM_PROGRAM " --help");
  } catch (const CLI::ParseError& error) {
    throw InputError(error.what(), "command line", "see " HYBRID_SLAM_PROGRAM " --help");
  }
}

/// Runs a program's work. Returns 2 for wrong input, 1 for any other exception, a full disk or a full
/// standard output.
/// @param words  message for any other exception
inline int exitCodeOf(const std::function<int()>& work,
                      const std::function<std::string(const std::exception&)>& words = messageOf) {
  openStandardDescriptors();
  keepWriteErrors();
  endWithAnErrorLine();
  try {
    const int code = work();
    if (code == 0 && !isPrinted())
      return fail(1, "cannot write: standard output; expected free disk space or an open pipe");
    return code;
  } catch (const files::DiskError& error) {
    return fail(1, error.what());
  } catch (const InputError& error) {
    return fail(2, error.what());
  } catch (const std::exception& error) {
    return fail(1, words(error));
  }
}

/// Message for a failed run, identified by its INI file or log.
inline std::string runFailed(const std::string& file, const std::exception& error) {
  return "run failed: " + file + "; " + messageOf(error);
}

}  // namespace hybrid_slam
