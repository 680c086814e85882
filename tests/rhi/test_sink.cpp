#include "test_sink.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rhi_test {

void TestSink::OnMessage(const rhi::Message& m) {
  if (m.severity < rhi::Severity::Warning) return;
  std::string text = std::string(rhi::ToString(m.severity)) + " " + rhi::ToString(m.code);
  if (m.apiId) text += " (" + std::to_string(m.apiId) + ")";
  if (*m.object) text += std::string(" '") + m.object + "'";
  text += std::string(": ") + m.text;
  const std::lock_guard lock(mutex_);
  entries_.push_back({m.code, m.apiId, std::move(text)});
}

void TestSink::Expect(rhi::MsgCode code, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  rules_[code] = {reason, true};
}

void TestSink::Allow(rhi::MsgCode code, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  rules_.try_emplace(code, Rule{reason, false});
}

int TestSink::Count(rhi::MsgCode code) const {
  const std::lock_guard lock(mutex_);
  return int(std::count_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.code == code; }));
}

std::string TestSink::LastText(rhi::MsgCode code) const {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(entries_.rbegin(), entries_.rend(), [&](const Entry& e) { return e.code == code; });
  return found == entries_.rend() ? "" : found->text;
}

std::string TestSink::Dump() const {
  const std::lock_guard lock(mutex_);
  std::string all;
  for (const Entry& e : entries_) all += e.text + "\n";
  return all;
}

std::vector<std::string> TestSink::TakeProblems() {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> problems;
  std::map<std::pair<rhi::MsgCode, int32_t>, size_t> seen;  // one problem for each kind, lest a loop floods the log
  for (const Entry& e : entries_)
    if (!rules_.contains(e.code) && seen[{e.code, e.apiId}]++ == 0) problems.push_back("unexpected message: " + e.text);
  for (const auto& [code, rule] : rules_) {
    const bool came = std::any_of(entries_.begin(), entries_.end(), [c = code](const Entry& e) { return e.code == c; });
    if (rule.required && !came)
      problems.push_back(std::string("no message ") + rhi::ToString(code) + " came; it was expected: " + rule.reason);
  }
  entries_.clear();
  rules_.clear();
  return problems;
}

void TestSink::Verify() {
  for (const std::string& problem : TakeProblems()) ADD_FAILURE() << problem;
}

}  // namespace rhi_test
