#include "apps/version.hpp"

namespace wingbeat {

std::string_view version() { return WINGBEAT_VERSION; }
std::string_view git_commit() { return WINGBEAT_COMMIT; }
std::string_view source_folder() { return WINGBEAT_SOURCE_DIR; }

}  // namespace wingbeat
