#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace wingbeat {

// Wall time of named, nested parts of a program on this rank:
//   Timer timer;
//   { auto part = timer.measure("steady"); ... { auto inner = timer.measure("assembly"); ... } }
// A part entered again adds to its time and count.
class Timer {
 public:
  struct Part {
    std::string path;  // "steady/assembly"
    int depth = 0;     // 0: outermost
    double seconds = 0.0;
    long count = 0;
  };

  // Stops the clock of its part when it goes out of scope. Parts must end in reverse order.
  class Scope {
   public:
    explicit Scope(Timer& timer) : timer_(&timer) {}
    Scope(Scope&& other) noexcept : timer_(other.timer_) { other.timer_ = nullptr; }
    Scope& operator=(Scope&&) = delete;
    ~Scope() {
      if (timer_) timer_->stop();
    }

   private:
    Timer* timer_;
  };

  Timer();
  [[nodiscard]] Scope measure(std::string_view name);

  double elapsed() const;  // seconds since the timer was made
  // In order of first entry, inner parts after the part that holds them; running parts up to now.
  std::vector<Part> parts() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Node {
    std::string name;
    int parent = -1;
    std::vector<int> children{};
    Clock::duration spent{};
    long count = 0;
    Clock::time_point started{};
    bool is_running = false;
  };

  void stop();
  void append(int node, const std::string& prefix, int depth, std::vector<Part>& parts) const;

  std::vector<Node> nodes_;  // node 0 is the whole
  int current_ = 0;
};

}  // namespace wingbeat
