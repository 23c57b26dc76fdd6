#include "readings/BagPlan.h"

#include <algorithm>
#include <iomanip>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "bags/ByteCursor.h"
#include "base/Errors.h"
#include "base/Terminal.h"

namespace hybrid_slam::readings {

using bags::MessageType;
using Entry = BagContents::Entry;

namespace {

bool isLaser(const Entry& entry) {
  return entry.topic.messageType == MessageType::laserScan ||
         entry.topic.messageType == MessageType::multiEchoLaserScan;
}

bool isScan(const Entry& entry) { return isLaser(entry) && entry.messages > entry.broken; }

bool isOdometry(const Entry& entry) {
  return entry.messages > entry.broken && entry.topic.messageType == MessageType::odometry;
}

std::string listOf(const std::vector<const Entry*>& entries) {
  constexpr size_t kMost = 20;
  std::string all;
  for (size_t i = 0; i < std::min(entries.size(), kMost); ++i)
    all += (i == 0 ? "" : ", ") + entries[i]->topic.name + " (" + entries[i]->topic.type + ", " +
           std::to_string(entries[i]->messages) + " messages)";
  return entries.empty() ? "no topics" : all + (entries.size() > kMost ? ", ..." : "");
}

template <class Test>
std::vector<const Entry*> select(const BagContents& contents, const Test& test) {
  std::vector<const Entry*> found;
  for (const Entry& entry : contents.topics)
    if (test(entry)) found.push_back(&entry);
  return found;
}

const Entry* named(const std::vector<const Entry*>& entries, const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const Entry* entry) { return entry->topic.name == name; });
  return found == entries.end() ? nullptr : *found;
}

/// Notes what a message states about frames.
void note(const bags::Message& message, Entry& entry, FrameTree& frames) {
  if (const auto* scan = std::get_if<bags::ScanMessage>(&message)) {
    if (entry.frame.empty()) entry.frame = scan->header.frame;
  } else if (const auto* odometry = std::get_if<bags::OdometryMessage>(&message)) {
    if (entry.frame.empty()) entry.frame = odometry->childFrame;
  } else {
    for (const auto& transform : std::get<std::vector<bags::TransformMessage>>(message))
      frames.add(transform);
  }
}

/// Returns why a message cannot be decoded.
std::string whyBroken(std::string_view bytes, const char* what) {
  const bool isCompressed = bytes.substr(0, 4) == "\x28\xb5\x2f\xfd";  // zstd
  return isCompressed ? "each is compressed; expected compression by file, as `ros2 bag convert` writes it"
                      : what;
}

/// The scan topics to use.
std::vector<const Entry*> scansOf(const BagContents& contents, const BagOptions& options,
                                  const std::string& file) {
  const auto scans = select(contents, isScan);
  for (const Entry& entry : contents.topics)
    if (scans.empty() && isLaser(entry) && entry.broken > 0)
      throw InputError("no laser scans that can be read", file,
                       "all messages of " + entry.topic.name + " are broken: " + entry.why);
  if (scans.empty())
    throw InputError(
        "no laser scans", file,
        "expected messages of sensor_msgs/LaserScan or MultiEchoLaserScan; the bag has " + contents.list());
  if (options.topics.empty()) return scans;
  std::vector<const Entry*> wanted;
  for (const std::string& topic : options.topics) {
    wanted.push_back(named(scans, topic));
    if (!wanted.back())
      throw InputError("no scans on the topic `" + topic + "`", file,
                       "--topic or [input] sensor_label: the bag has " + listOf(scans));
  }
  return wanted;
}

/// Returns a line for each laser that is not used: its topic and the reason.
std::vector<std::string> ignoredLasers(const BagContents& contents, const BagOptions& options,
                                       const std::vector<const Entry*>& used) {
  std::vector<std::string> all;
  for (const Entry* entry : select(contents, isLaser)) {
    const char* const why = !options.topics.empty() ? "not in --topic or [input] sensor_label"
                            : entry->messages == 0  ? "no messages"
                                                    : "all its messages are broken";
    if (!named(used, entry->topic.name))
      all.push_back("laser `" + entry->topic.name + "` is not used: " + why);
  }
  return all;
}

/// The odometry topic to use; null: none.
const Entry* odometryOf(const BagContents& contents, const BagOptions& options, const std::string& file) {
  const auto all = select(contents, isOdometry);
  if (!options.odometryTopic.empty()) {
    if (const Entry* entry = named(all, options.odometryTopic)) return entry;
    const auto transforms = select(
        contents, [](const Entry& entry) { return entry.topic.messageType == MessageType::transforms; });
    if (named(transforms, options.odometryTopic)) return nullptr;
    throw InputError(
        "no odometry on the topic `" + options.odometryTopic + "`", file,
        "--odometry-topic or [input] odometry_topic: the bag has " + listOf(all.empty() ? transforms : all));
  }
  if (all.size() > 1)
    throw InputError("several odometry topics", file,
                     "choose with --odometry-topic or [input] odometry_topic: " + listOf(all));
  return all.empty() ? nullptr : all.front();
}

bool endsWith(const std::string& name, const std::string& end) {
  return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

/// Frames above a laser: the one named `odom`, the base below it, and those with the name of a base. Where
/// the transforms of the laser are missing (often /tf_static), the only frame below `odom` is the base.
struct Base {
  std::string odom, below;
  std::vector<std::string> candidates;
};

Base baseAbove(const FrameTree& frames, const std::string& laser) {
  Base base;
  const std::vector<std::string> path = frames.ancestors(laser);
  for (size_t i = 1; i < path.size() && base.odom.empty(); ++i)
    if (path[i].find("odom") != std::string::npos) {
      base.odom = path[i];
      base.below = path[i - 1];
    }
  if (const auto bases = frames.childrenOf("odom"); base.odom.empty() && bases.size() == 1) {
    base.below = bases.front();
    base.odom = frames.ancestors(base.below).at(1);
  }
  for (const char* name : {"base_footprint", "base_link"})
    for (const std::string& frame : path)
      if (endsWith(frame, name)) base.candidates.push_back(frame);
  return base;
}

}  // namespace

std::string BagContents::list() const {
  return listOf(select(*this, [](const Entry&) { return true; }));
}

std::string BagContents::table() const {
  std::vector<const Entry*> all = select(*this, [](const Entry&) { return true; });
  std::sort(all.begin(), all.end(),
            [](const Entry* a, const Entry* b) { return a->topic.name < b->topic.name; });
  std::ostringstream out;
  for (const Entry* entry : all)
    out << std::setw(9) << entry->messages << "  " << onOneLine(entry->topic.name + "  " + entry->topic.type)
        << "\n";
  return out.str();
}

BagContents contentsOf(const std::string& file, const std::function<bool()>& isStopped) {
  const auto bag = bags::openBag(file);
  BagContents contents;
  const auto noteTopics = [&] {
    for (size_t i = contents.topics.size(); i < bag->topics().size(); ++i)
      contents.topics.push_back({bag->topics()[i], 0, 0, {}, {}});
  };
  for (size_t number = 1; const auto message = bag->next(); ++number) {
    if (isStopped())
      throw std::runtime_error("interrupted: message " + std::to_string(number) + " of " + file);
    noteTopics();
    Entry& entry = contents.topics[message->topic];
    ++entry.messages;
    if (!entry.topic.messageType) continue;
    // A scan's frame is that of its first message.
    if (!entry.frame.empty()) continue;
    try {
      note(bags::decodeMessage(*entry.topic.messageType, entry.topic.encoding, message->bytes), entry,
           contents.frames);
    } catch (const bags::BrokenBytes& broken) {
      if (entry.broken++ == 0) entry.why = whyBroken(message->bytes, broken.what());
    }
  }
  noteTopics();
  contents.defect = bag->defect();
  if (contents.topics.empty() && !contents.defect.empty())
    throw InputError(std::string(bag->format()) + " " + contents.defect, file, "expected a whole file");
  return contents;
}

BagPlan planOf(const BagContents& contents, const BagOptions& options, const std::string& file) {
  std::vector<const Entry*> scans = scansOf(contents, options, file);
  const Entry* const odometry = odometryOf(contents, options, file);
  const Base above = baseAbove(contents.frames, scans.front()->frame);

  BagPlan plan;
  std::vector<std::string> bases = above.candidates;
  if (!above.below.empty()) bases.insert(bases.begin(), above.below);
  if (odometry) {
    plan.odometryTopic = odometry->topic.name;
    if (!odometry->frame.empty()) bases.insert(bases.begin(), odometry->frame);
  } else {
    plan.odomFrame = above.odom;
    plan.baseFrame = above.below;
    if (above.odom.empty() && !options.odometryTopic.empty())
      throw InputError("no odometry among the transforms", file,
                       "expected one from a frame `odom` to the base of the robot");
  }
  const std::string expectedBase = bases.empty() ? "base_link" : bases.front();
  std::set<std::string> used;
  for (const Entry* scan : scans) {
    BagPlan::Laser laser{scan->topic.name, {}, false};
    for (const std::string& base : bases) {
      const auto pose = contents.frames.pose(base, scan->frame);
      if (!pose) continue;
      laser.pose = pose->asTPose();
      laser.isMountingKnown = true;
      if (contents.frames.moves(base, scan->frame))
        plan.notes.push_back("the laser of " + scan->topic.name + " moves on the robot: frame `" +
                             scan->frame + "`; its first pose is used");
      if (contents.frames.isAmbiguous(base, scan->frame))
        plan.notes.push_back("the transforms to the laser of " + scan->topic.name +
                             " have several parents: frame `" + scan->frame + "`; the first is used");
      break;
    }
    const bool isNewFrame = used.insert(scan->frame).second;
    if (scans.size() > 1 && options.topics.empty() && (!isNewFrame || !laser.isMountingKnown))
      throw InputError("several scan topics", file,
                       "choose with --topic or [input] sensor_label: " + listOf(scans));
    const std::string missing = "no transform from `" + expectedBase + "` to `" + scan->frame + "`";
    if (scans.size() > 1 && !laser.isMountingKnown)
      throw InputError(
          missing, file,
          "expected the poses of several lasers, or one chosen with --topic or [input] sensor_label");
    if (!laser.isMountingKnown)
      plan.notes.push_back(missing + ": the laser of " + scan->topic.name +
                           " is taken to be at the robot's centre, facing ahead");
    plan.lasers.push_back(laser);
  }
  for (const std::string& line : ignoredLasers(contents, options, scans)) plan.notes.push_back(line);
  return plan;
}

}  // namespace hybrid_slam::readings
