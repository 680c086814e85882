// Errors as values: what went wrong, where, and what to do about it.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace fur {

// The program's exit codes are these values (docs/errors.md).
enum class ErrorCode {
  Internal = 1,
  Usage = 2,          // flags or parameter values that make no sense
  InputMissing = 3,   // a file that is not there or cannot be read
  InputMalformed = 4, // a file that is not what it should be
  OutputFailed = 5,   // a file that cannot be written
  NoDevice = 6,       // no usable driver, or one without a needed feature
  RenderFailed = 7,   // the driver failed, or non-finite pixels
  ComparisonFailed = 8  // two pictures are further apart than a limit allows
};

struct Error {
  ErrorCode code = ErrorCode::Internal;
  std::string message;  // one line, without "error:"
};

// Either a value or an Error.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : v_(std::move(value)) {}
  Result(Error error) : v_(std::move(error)) {}
  explicit operator bool() const { return v_.index() == 0; }
  T& operator*() { return std::get<0>(v_); }
  const T& operator*() const { return std::get<0>(v_); }
  T* operator->() { return &std::get<0>(v_); }
  const T* operator->() const { return &std::get<0>(v_); }
  const Error& error() const { return std::get<1>(v_); }

 private:
  std::variant<T, Error> v_;
};

// Success without a value.
struct Done {};

}  // namespace fur
