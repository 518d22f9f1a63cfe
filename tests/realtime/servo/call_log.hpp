// Which system calls this thread makes: each is noted, and then made all the same.
#pragma once

#include <set>
#include <string>

namespace dashpot::tests {

// False where the kernel or the processor cannot do it, or under a sanitizer.
bool can_log_calls();

void begin_call_log();  // for the calling thread
void end_call_log();

std::set<long> take_logged_calls();  // by number
std::string name_of_call(long number);

}  // namespace dashpot::tests
