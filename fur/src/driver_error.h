// A failed RHI call as an Error of this library.
#pragma once

#include <string>

#include "fur/result.h"
#include "rhi/types.h"

namespace fur {

// "WHAT: status". NoDevice where the driver lacks something, else RenderFailed.
inline Error DriverError(rhi::Status status, const std::string& what) {
  const ErrorCode code = status == rhi::Status::Unsupported ? ErrorCode::NoDevice : ErrorCode::RenderFailed;
  return {code, what + ": " + rhi::ToString(status)};
}

}  // namespace fur
