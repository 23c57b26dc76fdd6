#include "base/Errors.h"

#include <mrpt/core/exceptions.h>

#include <algorithm>

namespace hybrid_slam {

std::string messageOf(const std::exception& exception) {
  const auto* mrpt = dynamic_cast<const mrpt::ExceptionWithCallBackBase*>(&exception);
  std::string text = mrpt ? mrpt->originalWhat : exception.what();
  if (mrpt) text.erase(0, text.find("] ") + 2);  // "FILE:LINE: [FUNCTION] MESSAGE"
  text.erase(text.find_last_not_of(" \n") + 1);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace hybrid_slam
