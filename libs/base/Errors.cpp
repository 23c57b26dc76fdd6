#include "base/Errors.h"

#include <mrpt/core/exceptions.h>

#include <algorithm>
#include <new>
#include <regex>

namespace hybrid_slam {
namespace {

/// Removes the call stacks of MRPT's exceptions whose text another message quotes.
std::string withoutCallStacks(const std::string& text) {
  static const std::regex head("==== MRPT exception ====\nMessage: *");
  static const std::regex stack("\nLocation: [^\n]*(?=\n)|\nCall stack backtrace:(\n\\[[0-9]+ *\\][^\n]*)*");
  return std::regex_replace(std::regex_replace(text, head, ""), stack, "");
}

/// The exception's message without the code location and call stack of MRPT.
std::string plainMessageOf(const std::exception& exception) {
  const auto* mrpt = dynamic_cast<const mrpt::ExceptionWithCallBackBase*>(&exception);
  std::string text = mrpt ? mrpt->originalWhat : exception.what();
  if (const auto end = text.find("] "); mrpt && end != std::string::npos)
    text.erase(0, end + 2);  // "FILE:LINE: [FUNCTION] MESSAGE"
  if (text.find("==== MRPT") != std::string::npos) text = withoutCallStacks(text);
  text.erase(text.find_last_not_of(" \n") + 1);
  return text;
}

}  // namespace

std::string InputError::visible(std::string text) {
  for (size_t at = 0; (at = text.find('\0', at)) != std::string::npos; at += 4) text.replace(at, 1, "\\x00");
  return text;
}

bool isOutOfMemory(const std::exception& exception) {
  if (dynamic_cast<const std::bad_alloc*>(&exception)) return true;
  const std::string message = plainMessageOf(exception);
  return message == "dereferencing nullptr poly_ptr" ||                  // MRPT's allocator returned null
         message.find("(-4:Insufficient memory)") != std::string::npos;  // OpenCV
}

std::string messageOf(const std::exception& exception) {
  if (isOutOfMemory(exception)) return "out of memory";
  std::string text = plainMessageOf(exception);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace hybrid_slam
