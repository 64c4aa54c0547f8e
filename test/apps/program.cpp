#include "test/apps/program.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

std::string read_text(const fs::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string quoted(const std::string& argument) {
  std::string text = "'";
  for (const char c : argument) {
    if (c == '\'') text += "'\\'";
    text += c;
  }
  text += '\'';
  return text;
}

}  // namespace

void Program::SetUp() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  folder_ = fs::temp_directory_path() /
            ("wingbeat-" + std::string(test->name()) + "-" + std::to_string(::getpid()));
  fs::create_directories(folder_);
}

void Program::TearDown() { fs::remove_all(folder_); }

ProgramRun Program::run(const std::vector<std::string>& arguments, int ranks) const {
  const fs::path output = folder_ / ".output", errors = folder_ / ".errors";
  std::string command = "cd " + quoted(folder_.string()) + " && ";
  if (ranks > 0) command += WINGBEAT_MPIEXEC " -n " + std::to_string(ranks) + " ";
  command += quoted(program_);
  for (const auto& argument : arguments) {
    command += ' ';
    command += quoted(argument);
  }
  command += " > " + quoted(output.string()) + " 2> " + quoted(errors.string()) + " < /dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(output), read_text(errors)};
}

int Program::run_and_signal(const std::vector<std::string>& arguments, const std::string& awaited,
                            int signal) const {
  fs::remove(folder_ / ".output");
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), program_);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::chdir(folder_.c_str()) != 0 || !std::freopen(".output", "w", stdout)) ::_exit(99);
    ::execv(program_.c_str(), pointers.data());
    ::_exit(98);
  }
  for (int i = 0; i < 6000 && read(".output").find(awaited) == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string Program::small_case() {
  return "[mesh]\nairfoil = \"naca64a010\"\ncells = [48, 12]\n[flow]\nmach = 0.8\n"
         "[pitch]\namplitude_deg = 1.0\nreduced_frequency = 0.2\n"
         "[structure]\nelastic_axis = -0.6\nstatic_unbalance = 0.25\ngyration_radius_squared = 0.75\n"
         "frequency_ratio = 0.5\nmass_ratio = 75\n";
}

void Program::write(const std::string& name, const std::string& text) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name) << text;
}

std::string Program::read(const std::string& name) const { return read_text(folder_ / name); }

nlohmann::json Program::result(const std::string& output) const {
  return nlohmann::json::parse(read(output + "/result.json"));
}

std::set<std::string> Program::files(const std::string& output) const {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_ / output))
    names.insert(entry.path().filename().string());
  return names;
}

void Program::expect_refused(const ProgramRun& run, const std::string& output,
                             const std::string& message) const {
  EXPECT_EQ(run.exit_code, 2) << run.errors;
  expect_in(message, run.errors);
  const auto json = result(output);
  EXPECT_EQ(json["status"], "error");
  expect_in(message, json["message"].get<std::string>());
  const std::set<std::string> allowed{"case.toml", "log.txt", "result.json"};
  for (const auto& name : files(output)) EXPECT_TRUE(allowed.contains(name)) << "left behind: " << name;
}

void expect_in(const std::string& part, const std::string& whole) {
  EXPECT_NE(whole.find(part), std::string::npos) << "missing: " << part << "\nin: " << whole;
}

}  // namespace wingbeat
