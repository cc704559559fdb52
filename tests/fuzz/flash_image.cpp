// A flash image of any content: parameter store and fault log find an intact record or none, and a commit on
// top of whatever lies there is what the next start loads.
#include "common/params/store.hpp"
#include "common/safety/fault_log.hpp"
#include "hal/sim/flash.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

using Part = sim::SimulatedFlash<2, 4096, 4>;  // two sectors: what all boards have at least

}  // namespace

void take(ByteView input) {
  {
    Part flash(input);
    Store<Part> store(flash);
    const Load found = store.load();
    require(static_cast<bool>(validate(found.set)), "a loaded set is valid");
    ParameterSet set;
    if (store.commit(set)) {
      Store<Part> again(flash);
      const Load now = again.load();
      require(now.status == LoadStatus::loaded && now.set == set, "what was committed is what is loaded");
    }
    require(flash.misuses() == 0, "the flash is used as it may be");
  }
  Part flash(input);
  FaultLog<Part> log(flash);
  std::uint32_t shown = 0;
  log.walk([&](const LoggedFault&) { return ++shown <= 2 * FaultLog<Part>::kSlots; });
  require(shown <= 2 * FaultLog<Part>::kSlots, "the log ends");
  if (log.append({}, 1)) require(log.get(0).has_value(), "what was appended is found");
  require(flash.misuses() == 0, "the flash is used as it may be");
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> all;
  const auto keep = [&](Part& flash) {
    const auto content = flash.content();
    all.emplace_back(content.begin(), content.end());
  };
  Part parameters, faults;
  Store<Part> store(parameters);
  FaultLog<Part> log(faults);
  for (int i = 0; i < 3; ++i) {
    if (!store.commit(ParameterSet{}) || !log.append({}, 1)) return {};
    keep(parameters);
    keep(faults);
  }
  return all;
}

}  // namespace astro::fuzz
