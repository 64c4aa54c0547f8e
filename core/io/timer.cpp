#include "core/io/timer.hpp"

#include <algorithm>

namespace wingbeat {

Timer::Timer() { nodes_.push_back({.name = "", .started = Clock::now(), .is_running = true}); }

Timer::Scope Timer::measure(std::string_view name) {
  const auto& siblings = nodes_[current_].children;
  const auto found = std::ranges::find_if(siblings, [&](int child) { return nodes_[child].name == name; });
  int node = 0;
  if (found != siblings.end()) {
    node = *found;
  } else {
    node = static_cast<int>(nodes_.size());
    nodes_.push_back({.name = std::string(name), .parent = current_});
    nodes_[current_].children.push_back(node);
  }
  current_ = node;
  nodes_[node].started = Clock::now();
  nodes_[node].is_running = true;
  return Scope(*this);
}

void Timer::stop() {
  Node& node = nodes_[current_];
  node.spent += Clock::now() - node.started;
  node.is_running = false;
  ++node.count;
  current_ = node.parent;
}

double Timer::elapsed() const {
  return std::chrono::duration<double>(Clock::now() - nodes_[0].started).count();
}

std::vector<Timer::Part> Timer::parts() const {
  std::vector<Part> parts;
  for (const int child : nodes_[0].children) append(child, "", 0, parts);
  return parts;
}

void Timer::append(int index, const std::string& prefix, int depth, std::vector<Part>& parts) const {
  const Node& node = nodes_[index];
  Clock::duration spent = node.spent;
  if (node.is_running) spent += Clock::now() - node.started;
  const std::string path = prefix + node.name;
  parts.push_back({path, depth, std::chrono::duration<double>(spent).count(), node.count});
  for (const int child : node.children) append(child, path + "/", depth + 1, parts);
}

}  // namespace wingbeat
