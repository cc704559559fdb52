#pragma once

#include <gtest/gtest.h>

#include <random>

#include "common/params/store.hpp"
#include "hal/sim/flash.hpp"
#include "tests/common/params/random_set.hpp"

namespace astro::support {

template <class Flash>
Load load(Flash& flash) {  // as after a reboot: nothing but the flash is left
  Store<Flash> store(flash);
  return store.load();
}

template <class Flash>
bool commit(Flash& flash, const ParameterSet& set) {
  Store<Flash> store(flash);
  return store.commit(set).ok();
}

/// The same claims on the geometries of a small NOR chip, of a processor's page-programmed flash and of
/// byte-wise EEPROM emulation.
template <class Flash>
class StoreOn : public ::testing::Test {
 protected:
  Flash flash;
  std::mt19937 random{7};

  void TearDown() override { EXPECT_EQ(flash.misuses(), 0); }
};
using Geometries = ::testing::Types<sim::SimulatedFlash<2, 4096, 4>, sim::SimulatedFlash<4, 4096, 256>,
                                    sim::SimulatedFlash<3, 1024, 1>>;

}  // namespace astro::support
