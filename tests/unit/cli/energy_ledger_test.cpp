#include "cli/energy_ledger.h"

#include <gtest/gtest.h>

namespace brickfall::cli {
namespace {

TEST(EnergyLedger, ratioIsOfAllThatWasPutInSoFar) {
  EnergyLedger ledger;
  ledger.supply(100);
  ledger.measure(100);
  EXPECT_EQ(ledger.ratioMax(), 1);
  ledger.measure(60);  // friction took some
  ledger.supply(100);  // a launch
  ledger.measure(150);
  EXPECT_EQ(ledger.ratioMax(), 1);
  ledger.measure(220);
  EXPECT_DOUBLE_EQ(ledger.ratioMax(), 1.1);
  ledger.measure(100);
  EXPECT_DOUBLE_EQ(ledger.ratioMax(), 1.1);
}

TEST(EnergyLedger, nothingPutInIsNoRatio) {
  EnergyLedger ledger;
  ledger.measure(5);
  EXPECT_EQ(ledger.ratioMax(), 0);
}

}  // namespace
}  // namespace brickfall::cli
