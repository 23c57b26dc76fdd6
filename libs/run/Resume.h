/// @file Resume.h
/// @brief Configuration of a resumed run.
#pragma once

#include "run/Configuration.h"
#include "run/SessionFile.h"

namespace hybrid_slam::run {

/// Makes `configuration` that of the session. Output folder, log and number of threads may differ.
/// @throws InputError for any other key that the INI file or the command line changes, and for a session of
///         another version of the program, which might not give the same bytes
void adopt(Configuration& configuration, const SessionReader& session);

}  // namespace hybrid_slam::run
