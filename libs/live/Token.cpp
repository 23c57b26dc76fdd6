#include "live/Token.h"

#include <algorithm>
#include <fstream>

#include "base/Errors.h"

namespace hybrid_slam::live {

std::string readToken(const std::string& file, const std::string& where) {
  if (file.empty()) return {};
  std::ifstream in(file);
  if (!in)
    throw InputError("no such file `" + file + "`", where, "expected a file whose first line is the token");
  std::string token(kMaxToken + 1, '\0');
  in.read(token.data(), static_cast<std::streamsize>(token.size()));
  token.resize(static_cast<size_t>(in.gcount()));
  token.resize(std::min(token.find_first_of("\r\n"), token.size()));
  if (token.size() < kMinToken || token.size() > kMaxToken)
    throw InputError("wrong token in `" + file + "`", where,
                     "expected a first line of " + std::to_string(kMinToken) + " to " +
                         std::to_string(kMaxToken) + " characters");
  return token;
}

bool isSameToken(const std::string& shown, const std::string& expected) {
  if (shown.size() != expected.size()) return false;
  int difference = 0;
  for (size_t i = 0; i < shown.size(); ++i) difference |= shown[i] ^ expected[i];
  return difference == 0;
}

bool isLoopback(const std::string& address) {
  return address == "localhost" || address == "::1" || address.rfind("127.", 0) == 0;
}

}  // namespace hybrid_slam::live
