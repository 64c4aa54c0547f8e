#pragma once

#include <string>
#include <vector>

#include "apps/case_settings.hpp"

namespace wingbeat {

// A case as lines of text by which a later run recognises it: "section.key = value", defaults too. Keys that
// the case neither gives nor needs are left out.
std::string fingerprint(CaseSettings settings, const KeySources& sources);

// A key that two cases give other values. Text is as in the case file; "unset" where there is none.
struct KeyChange {
  std::string key;
  std::string before;
  std::string now;

  std::string section() const { return key.substr(0, key.find('.')); }
  std::string name() const { return key.substr(key.find('.') + 1); }
};
// `before`: lines of fingerprint(). Keys that one of the cases did not need are not compared.
std::vector<KeyChange> key_changes(const std::string& before, CaseSettings settings,
                                   const KeySources& sources);

// "flow.mach = 0.82 (was 0.8), ..."
std::string listed(const std::vector<KeyChange>& changes);

// True where the solution of one value is that of the other, or where it only says how many iterations are
// allowed, how much is asked for, or where cells live: an iteration then goes on as it was.
bool keeps_iteration(const KeyChange& change);
// True where the change makes another solution.
bool is_of_the_problem(const KeyChange& change, const std::string& verb);

}  // namespace wingbeat
