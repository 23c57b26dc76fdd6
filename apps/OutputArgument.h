/// @file OutputArgument.h
/// @brief The option `-o DIR`, whose name an INI file must be able to hold.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "base/Errors.h"

namespace hybrid_slam {

/// Adds `-o,--output DIR`. An empty name, as from an unset variable of the shell, is wrong.
inline CLI::Option* addOutput(CLI::App& app, std::string& output, const std::string& means) {
  return app.add_option("-o,--output", output, means)->type_name("DIR")->check([](const std::string& name) {
    return name.empty() ? std::string("the name is empty; expected a folder") : std::string();
  });
}

/// Rejects a file name that an INI file, and so config.ini and a session, cannot hold.
/// @param kept  the name after a passage through the configuration
/// @throws InputError
inline void expectKept(const std::string& given, const std::string& kept) {
  bool hasMacro = false;
  for (const char* macro : {"$env{", "$eval{", "@define"})
    hasMacro = hasMacro || given.find(macro) != std::string::npos;
  if (!given.empty() && (hasMacro || given != kept))
    throw InputError("wrong name `" + given + "`", "command line",
                     "expected one without line breaks, macros, `//`, and blanks at its ends");
}

}  // namespace hybrid_slam
