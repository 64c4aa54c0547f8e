#pragma once

#include "apps/context.hpp"
#include "structure/linear_flutter.hpp"

namespace wingbeat {

LinearFlutterOptions linear_flutter_options(const Context& context);

// The four numbers of a flutter point, as result.json names them.
nlohmann::ordered_json flutter_point(const CaseSettings& settings, double reduced_velocity, double omega);

// Prints all roots and puts the lowest into result.json as "linear_flutter", with the others in a list.
void report_linear_flutter(Context& context, const LinearFlutter& flutter);

// Says where no root was found and what to do.
std::string no_flutter_message(const CaseSettings& settings);

}  // namespace wingbeat
