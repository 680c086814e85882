// The one error type of the shader compiler: a list of places and what is wrong there.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace shaderc {

struct Where {
  std::string file;   // empty: the input file
  uint32_t line = 0;  // 0: unknown
};

struct Problem {
  Problem(Where at, std::string what) : where(std::move(at)), text(std::move(what)) {}
  Where where;
  std::string text;
};

// Thrown by every step; main prints each problem as "file:line: error: text".
class CompileError : public std::runtime_error {
 public:
  explicit CompileError(std::vector<Problem> list) : std::runtime_error("compile error"), problems(std::move(list)) {}
  explicit CompileError(std::string text) : CompileError(Where{}, std::move(text)) {}
  CompileError(Where where, std::string text) : CompileError({Problem{std::move(where), std::move(text)}}) {}
  std::vector<Problem> problems;
};

inline void ThrowIfAny(std::vector<Problem> problems) {
  if (!problems.empty()) throw CompileError(std::move(problems));
}

}  // namespace shaderc
