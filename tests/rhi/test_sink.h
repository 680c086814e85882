// A message sink that fails the test on any message of Warning or worse, unless the test has allowed its code.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "rhi/messages.h"

namespace rhi_test {

class TestSink final : public rhi::IMessageSink {
 public:
  void OnMessage(const rhi::Message&) override;

  // The test expects at least one message of this code; `reason` says why. Verify fails if none came.
  void Expect(rhi::MsgCode code, const std::string& reason);
  // Messages of this code may come, or not.
  void Allow(rhi::MsgCode code, const std::string& reason);
  // How many messages of this code came since the last Verify, and the text of the last one.
  int Count(rhi::MsgCode code) const;
  std::string LastText(rhi::MsgCode code) const;
  // All messages of Warning or worse, one a line.
  std::string Dump() const;

  // Reports what was not expected (the first of each kind), and what was expected and did not come, as failures of the
  // running test. Then forgets all.
  void Verify();
  // The same without gtest: the problems, empty when all is well.
  std::vector<std::string> TakeProblems();

 private:
  struct Rule {
    std::string reason;
    bool required;
  };
  struct Entry {
    rhi::MsgCode code;
    int32_t apiId;
    std::string text;
  };
  mutable std::mutex mutex_;
  std::map<rhi::MsgCode, Rule> rules_;
  std::vector<Entry> entries_;
};

}  // namespace rhi_test
