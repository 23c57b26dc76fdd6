/// @file JsonFile.h
/// @brief Reads the JSON files of a run's folder, which may be damaged.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hybrid_slam::run {

/// Reads a file of at most 1 MB and 10 levels; returns a discarded value for any other, and for broken JSON.
nlohmann::json readJson(const std::filesystem::path& file);

}  // namespace hybrid_slam::run
