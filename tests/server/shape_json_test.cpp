#include "server/shape_json.h"

#include <gtest/gtest.h>

namespace spherematch {
namespace {

ShapeRecord record(ShapeState state) {
  ShapeRecord record;
  record.id = std::string(32, '0');
  record.options = std::string("repair=none");
  record.state = state;
  record.vertices = 4;
  record.repair.filled_loops = 2;
  record.repair.dropped_components = 3;
  return record;
}

TEST(ShapeJson, AReadyShapeIsComplete) {
  ShapeRecord ready = record(ShapeState::ready);
  ready.sphere = SphereQuality{0, 0.5, 0.25};
  ready.seconds = {{"total", 3}};
  ready.engine = std::string("stub-1");
  ready.tags = {"a", "b"};
  // A job that has just ended may still be reported as running; the record knows better.
  const api::Shape shape = shape_of(ready, JobStatus{true, "eigenbasis", 0.9});
  EXPECT_EQ(shape.state, api::ShapeState::ready);
  EXPECT_EQ(shape.stage, "");
  EXPECT_EQ(shape.progress, 1);
  EXPECT_EQ(shape.sphere, (api::Sphere{0, 0.5, 0.25}));
  EXPECT_EQ(shape.seconds, ready.seconds);
  EXPECT_EQ(shape.engine, "stub-1");
  EXPECT_EQ(shape.tags, ready.tags);
  EXPECT_EQ(shape.repair.mode, "none");
  EXPECT_EQ(shape.repair.filled_loops, 2);
  EXPECT_EQ(shape.repair.dropped_components, 3);
  EXPECT_EQ(shape.error, std::nullopt);
}

TEST(ShapeJson, TellsOfADecimatedCopy) {
  ShapeRecord ready = record(ShapeState::ready);
  EXPECT_EQ(shape_of(ready, std::nullopt).simplified, std::nullopt);
  ready.options = std::string("repair=none;simplify=5000");
  ready.simplified = 4999;
  EXPECT_EQ(shape_of(ready, std::nullopt).simplified, 4999);
  EXPECT_EQ(shape_of(ready, std::nullopt).repair.mode, "none");
}

TEST(ShapeJson, AFailedShapeHasItsProblem) {
  ShapeRecord failed = record(ShapeState::failed);
  failed.error_code = std::string("parametrization-failed");
  failed.error_detail = "three flipped triangles remain";
  const api::Shape shape = shape_of(failed, std::nullopt);
  ASSERT_TRUE(shape.error.has_value());
  EXPECT_EQ(shape.error->code, api::Code::parametrization_failed);
  EXPECT_EQ(shape.error->detail, failed.error_detail);
  failed.error_code = std::string("of-a-later-release");
  EXPECT_EQ(shape_of(failed, std::nullopt).error->code, api::Code::internal);
}

TEST(ShapeJson, AnUnfinishedShapeShowsItsJob) {
  const api::Shape running = shape_of(record(ShapeState::queued), JobStatus{true, "authalic", 0.5});
  EXPECT_EQ(running.state, api::ShapeState::processing);
  EXPECT_EQ(running.stage, "authalic");
  EXPECT_EQ(running.progress, 0.5);
  EXPECT_EQ(shape_of(record(ShapeState::processing), JobStatus{}).state, api::ShapeState::queued);
  EXPECT_EQ(shape_of(record(ShapeState::processing), std::nullopt).state, api::ShapeState::processing);
}

}  // namespace
}  // namespace spherematch
