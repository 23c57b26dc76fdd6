/// @file TopicArguments.h
/// @brief Command-line options that choose the topics of a bag.
#pragma once

#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "SettingArguments.h"
#include "base/Errors.h"
#include "readings/BagPlan.h"

namespace hybrid_slam {

struct TopicArguments {
  readings::BagOptions bag;
  bool wantsList = false;

  /// Adds --topic, --odometry-topic and --list.
  /// @param choosesLabels  of the sensors of other logs than bags, too
  void add(CLI::App& app, bool choosesLabels) {
    app.add_option("--topic", bag.topics,
                   choosesLabels
                       ? "label of a laser, bag: topic of its scans; repeatable (default: all)"
                       : "bag: topic of a laser's scans, repeatable (default: all topics with scans)")
        ->type_name("TOPIC")
        ->allow_extra_args(false);
    app.add_option(
           "--odometry-topic", bag.odometryTopic,
           std::string(choosesLabels ? "label of the odometry (default: that of the first reading); " : "") +
               "bag: topic of the odometry, nav_msgs/Odometry or transforms (default: the only one with "
               "nav_msgs/Odometry, else the transforms)")
        ->type_name("TOPIC");
    app.add_flag("--list", wantsList, "print the topics of a bag: messages, name, type");
  }
  /// Appends the given options to the settings.
  void addTo(std::vector<std::string>& settings) const {
    std::string labels;
    for (const std::string& topic : bag.topics) labels += (labels.empty() ? "" : ", ") + topic;
    if (!labels.empty()) set(settings, "input.sensor_label", labels);
    if (!bag.odometryTopic.empty()) set(settings, "input.odometry_topic", bag.odometryTopic);
  }
};

/// Prints the topics of a bag; if they are incomplete, prints the reason on standard error.
inline void printTopics(const std::string& file) {
  const readings::BagContents contents = readings::contentsOf(file);
  std::cout << contents.table();
  if (!contents.defect.empty())
    throw InputError(contents.defect, file, "the list covers the bag up to this point");
}

}  // namespace hybrid_slam
