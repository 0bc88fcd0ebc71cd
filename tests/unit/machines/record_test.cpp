// Records of accelerations: what is read, and what is refused with its line.
#include "brickfall/machines.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

std::string faultOf(const std::string& text, const RecordFormat& format = {}) {
  const Result<AccelerationRecord> record = readAccelerationRecord(text, "r.csv", format);
  return record.ok() ? "" : record.error().message;
}

TEST(Record, ReadsAnySamplingWithItsUnits) {
  const std::string text = "# station 7\n\ntime, east, up\r\n0, 1, 5\n10, -2, 6 # a note\n15,+3e-1,7\n40,0,8";
  const Result<AccelerationRecord> east = readAccelerationRecord(text, "r", {9.81, 1e-3, 1});
  ASSERT_TRUE(east.ok()) << east.error().message;
  ASSERT_EQ(east->times.size(), 4u);
  EXPECT_DOUBLE_EQ(east->times[3], 0.04);
  EXPECT_DOUBLE_EQ(east->values[2], 0.3 * 9.81);
  EXPECT_DOUBLE_EQ(readAccelerationRecord(text, "r", {1, 1, 2})->values[2], 7);
  EXPECT_EQ(readAccelerationRecord("0 1\n1 2\n2 3\n", "r", {})->values.size(), 3u);
  EXPECT_EQ(readAccelerationRecord("0;1\n1;2", "r", {})->values.size(), 2u);
}

TEST(Record, NamesTheLineOfWhatIsWrong) {
  EXPECT_EQ(faultOf("0,1\n0.1,\n0.2,3\n"), "r.csv:2: found nothing in column 2, expected an acceleration");
  EXPECT_EQ(faultOf("0,1\n0.1,nan\n"), "r.csv:2: found \"nan\" in column 2, expected an acceleration");
  EXPECT_EQ(faultOf("0,1\n0.1,1e999\n"), "r.csv:2: found \"1e999\" in column 2, expected an acceleration");
  EXPECT_EQ(faultOf("t,a\n0,1\nx,2\n"), "r.csv:3: found \"x\" in column 1, expected a time");
  EXPECT_EQ(faultOf("0,1\n0.2,1\n\n0.1,2\n"),
            "r.csv:4: found the time 0.100000 s after 0.200000 s, expected times that ascend");
  EXPECT_EQ(faultOf("0,1\n0,2\n"), "r.csv:2: found the time 0.000000 s after 0.000000 s, expected times that ascend");
  EXPECT_EQ(faultOf("0,1\n1,1\n2,1\n20,1\n21,1"),
            "r.csv:4: found 18.000000 s since the sample before, expected no gap (usual: 1.000000 s)");
  EXPECT_EQ(faultOf("0,1\n1,1\n", {1, 1, 2}), "r.csv:1: found nothing in column 3, expected an acceleration");
  EXPECT_EQ(faultOf("0,1\n"), "r.csv: found 1 samples, expected at least 2");
  EXPECT_EQ(faultOf(""), "r.csv: found 0 samples, expected at least 2");
  EXPECT_EQ(faultOf("a,b\nc,d\n"), "r.csv:2: found \"c\" in column 1, expected a time");
  EXPECT_NE(faultOf("0,1\n1,1\n", {1, 1, 0}), "");
  EXPECT_NE(faultOf("0,1\n1,1\n", {NAN, 1, 1}), "");
}

}  // namespace
}  // namespace brickfall
