#include "bags/Messages.h"

#include <cmath>

#include "bags/ByteCursor.h"

namespace hybrid_slam::bags {
namespace {

/// Reads the fields of a message in sequence.
class Fields {
 public:
  Fields(Encoding encoding, std::string_view bytes)
      : isCdr_(encoding == Encoding::cdr), cursor_(bodyOf(encoding, bytes), isBigEndian(encoding, bytes)) {}

  template <class Number>
  Number number() {
    align(sizeof(Number));
    return cursor_.number<Number>();
  }
  double finite(double value, const char* what) const {
    if (!std::isfinite(value)) throw BrokenBytes(std::string(what) + " is not finite");
    return value;
  }
  double finiteFloat(const char* what) { return finite(number<float>(), what); }
  double finiteDouble(const char* what) { return finite(number<double>(), what); }
  std::string string() {
    align(4);
    std::string_view text = cursor_.block();
    if (isCdr_ && !text.empty() && text.back() == '\0') text.remove_suffix(1);
    if (text.size() > 256) throw BrokenBytes("a name is too long");
    return printable(text);
  }
  /// Reads the length of a sequence. Each element takes at least `elementBytes`.
  size_t count(size_t elementBytes) {
    const auto claimed = number<uint32_t>();
    if (claimed > cursor_.left() / elementBytes) throw BrokenBytes("it ends too early");
    return claimed;
  }
  void skipNumbers(size_t count, size_t bytes) {
    if (count > 0) align(bytes);
    cursor_.take(count * bytes);
  }
  /// @throws BrokenBytes if bytes follow, other than the padding of CDR
  void end() const {
    if (cursor_.left() > (isCdr_ ? 7 : 0)) throw BrokenBytes("it is too long");
  }

  MessageHeader header() {
    MessageHeader out;
    if (!isCdr_) number<uint32_t>();  // sequence number
    const double seconds = isCdr_ ? number<int32_t>() : static_cast<double>(number<uint32_t>());
    out.time = seconds + 1e-9 * number<uint32_t>();
    if (out.time < 0) throw BrokenBytes("its time is negative");
    out.frame = frame();
    return out;
  }
  std::string frame() {
    const std::string name = string();
    return name.empty() || name.front() != '/' ? name : name.substr(1);
  }
  FramePose pose() {
    FramePose p;
    for (double* value : {&p.x, &p.y, &p.z, &p.qx, &p.qy, &p.qz, &p.qw}) *value = finiteDouble("a pose");
    return p;
  }

 private:
  /// CDR begins with 4 bytes that name the byte order; numbers are aligned from there on.
  static std::string_view bodyOf(Encoding encoding, std::string_view bytes) {
    if (encoding == Encoding::ros1) return bytes;
    if (bytes.size() < 4 || bytes[0] != 0 || (bytes[1] != 0 && bytes[1] != 1))
      throw BrokenBytes("it is not plain CDR");
    return bytes.substr(4);
  }
  static bool isBigEndian(Encoding encoding, std::string_view bytes) {
    return encoding == Encoding::cdr && bytes.size() > 1 && bytes[1] == 0;  // may be asked before bodyOf
  }
  void align(size_t bytes) {
    if (isCdr_) cursor_.take((bytes - cursor_.at() % bytes) % bytes);
  }

  bool isCdr_;
  ByteCursor cursor_;
};

/// Normalises the quaternion; returns false if it is not a rotation.
bool normalise(FramePose& p) {
  const double norm = std::sqrt(p.qx * p.qx + p.qy * p.qy + p.qz * p.qz + p.qw * p.qw);
  if (!(std::abs(norm - 1) < 0.1)) return false;
  for (double* value : {&p.qx, &p.qy, &p.qz, &p.qw}) *value /= norm;
  return true;
}

std::vector<float> floats(Fields& in) {
  std::vector<float> values(in.count(sizeof(float)));
  for (float& value : values) value = in.number<float>();
  return values;
}

/// Reads the first echo of each beam; NaN where there is none.
std::vector<float> firstEchoes(Fields& in) {
  std::vector<float> values(in.count(sizeof(uint32_t)));
  for (float& value : values) {
    const std::vector<float> echoes = floats(in);
    value = echoes.empty() ? std::nanf("") : echoes.front();
  }
  return values;
}

ScanMessage scan(Fields& in, bool hasEchoes) {
  ScanMessage out;
  out.header = in.header();
  out.angleMin = in.finiteFloat("angle_min");
  in.number<float>();  // angle_max: of the last beam, or one step further
  out.angleStep = in.finiteFloat("angle_increment");
  out.timeStep = in.finiteFloat("time_increment");
  in.number<float>();  // scan_time
  out.rangeMin = in.number<float>();
  out.rangeMax = in.number<float>();
  out.ranges = hasEchoes ? firstEchoes(in) : floats(in);
  if (hasEchoes)
    firstEchoes(in);  // intensities
  else
    in.skipNumbers(in.count(sizeof(float)), sizeof(float));
  const double aperture = std::abs(out.angleStep) * static_cast<double>(out.ranges.size());
  if (out.ranges.size() > 1 && !(out.angleStep != 0 && aperture < 7))
    throw BrokenBytes("angle_increment does not fit the number of beams");
  return out;
}

OdometryMessage odometry(Fields& in) {
  OdometryMessage out;
  out.header = in.header();
  out.childFrame = in.frame();
  out.pose = in.pose();
  if (!normalise(out.pose)) throw BrokenBytes("its rotation is not a unit quaternion");
  in.skipNumbers(36 + 6 + 36, sizeof(double));  // covariance, twist, covariance
  return out;
}

std::vector<TransformMessage> transforms(Fields& in) {
  constexpr size_t kLeastBytes = 4 + 4 + 4 + 4 + 7 * sizeof(double);
  std::vector<TransformMessage> all;
  for (size_t left = in.count(kLeastBytes); left > 0; --left) {
    TransformMessage one;
    one.header = in.header();
    one.childFrame = in.frame();
    one.pose = in.pose();
    if (normalise(one.pose)) all.push_back(one);
  }
  return all;
}

}  // namespace

std::optional<MessageType> messageTypeOf(std::string_view name) {
  std::string plain(name);
  if (const size_t at = plain.find("/msg/"); at != std::string::npos) plain.erase(at, 4);
  if (plain == "sensor_msgs/LaserScan") return MessageType::laserScan;
  if (plain == "sensor_msgs/MultiEchoLaserScan") return MessageType::multiEchoLaserScan;
  if (plain == "nav_msgs/Odometry") return MessageType::odometry;
  if (plain == "tf2_msgs/TFMessage" || plain == "tf/tfMessage") return MessageType::transforms;
  return std::nullopt;
}

Message decodeMessage(MessageType type, Encoding encoding, std::string_view bytes) {
  if (bytes.size() > kMostMessageBytes) throw BrokenBytes("it has over 16 MiB");
  Fields in(encoding, bytes);
  Message message;
  switch (type) {
    case MessageType::laserScan:
    case MessageType::multiEchoLaserScan:
      message = scan(in, type == MessageType::multiEchoLaserScan);
      break;
    case MessageType::odometry:
      message = odometry(in);
      break;
    case MessageType::transforms:
      message = transforms(in);
      break;
  }
  in.end();
  return message;
}

}  // namespace hybrid_slam::bags
