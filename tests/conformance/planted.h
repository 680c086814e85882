// Cases that fail: what the suite must catch, in the suite itself (--plant).
#pragma once

namespace conformance {

void RegisterPlanted();  // before RUN_ALL_TESTS

}  // namespace conformance
