/// @file Resume.h
/// @brief The configuration of a run that is resumed.
#pragma once

#include "run/Configuration.h"
#include "run/SessionFile.h"

namespace hybrid_slam::run {

/// Makes `configuration` that of the session. Output folder, log and number of threads may differ.
/// @throws InputError for another key that the INI file or the command line sets to another value, and for a
///         session of another version of the program: it might not go on to the same bytes
void adopt(Configuration& configuration, const SessionReader& session);

}  // namespace hybrid_slam::run
