#include "apps/sweep_queue.hpp"

#include <algorithm>

namespace wingbeat {
namespace {

constexpr std::size_t stop_place = 0, left_place = 1, first_state = 2;

std::vector<long> board_of(const std::vector<PointState>& states) {
  std::vector<long> board(first_state, 0);
  for (const PointState state : states) board.push_back(static_cast<long>(state));
  return board;
}

}  // namespace

SweepQueue::SweepQueue(const Comm& world, PointPlaces points, const std::vector<PointState>& states)
    : points_(std::move(points)), board_(world, board_of(states)) {}

std::vector<PointState> SweepQueue::states_on(Board board) {
  std::vector<PointState> states;
  for (const long number : board.subspan(first_state)) states.push_back(static_cast<PointState>(number));
  return states;
}

std::optional<SweepQueue::Task> SweepQueue::take(std::optional<std::size_t> last,
                                                 const std::function<void(std::size_t point)>& record_begin) {
  std::optional<Task> task;
  board_.use([&](Board board) {
    if (board[stop_place] != 0) return;
    const std::vector<PointState> now = states_on(board);
    const auto point = next_point(points_, now, last);
    if (!point) return;
    record_begin(*point);
    task = Task{.point = *point, .start = nearest_done(points_, now, *point)};
    if (task->start) task->before = done_before(points_, now, *point, *task->start);
    board[first_state + *point] = static_cast<long>(PointState::running);
  });
  return task;
}

void SweepQueue::finish(std::size_t point, PointState state, const std::function<void()>& record) {
  board_.use([&](Board board) {
    record();
    board[first_state + point] = static_cast<long>(state);
  });
}

void SweepQueue::stop() {
  board_.use([](Board board) { board[stop_place] = 1; });
}

void SweepQueue::leave() {
  board_.use([](Board board) { ++board[left_place]; });
}

SweepQueue::Count SweepQueue::count() {
  Count count;
  board_.use([&](Board board) {
    const std::vector<PointState> now = states_on(board);
    count.done = static_cast<int>(std::ranges::count(now, PointState::done));
    count.failed = static_cast<int>(std::ranges::count(now, PointState::failed));
    count.left = static_cast<int>(now.size()) - count.done - count.failed;
    count.groups = static_cast<int>(board[left_place]);
  });
  return count;
}

std::vector<PointState> SweepQueue::states() {
  std::vector<PointState> now;
  board_.use([&](Board board) { now = states_on(board); });
  return now;
}

}  // namespace wingbeat
