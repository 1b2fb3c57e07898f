// The server's side of a preparation against programs that are no worker; the worker itself runs in tests/e2e/worker_test.py.
#include "server/preparation_process.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>

#include "server/engine_port.h"
#include "server/preparation_messages.h"
#include "storage/error.h"
#include "tests/storage/sample_shapes.h"

namespace spherematch {
namespace {

using namespace std::chrono_literals;

/// How the preparation was lost.
std::string loss(const std::string& program) {
  try {
    (void)preprocess_apart(program, 1, testing::sample_surface(12, 1), {});
  } catch (const PreparationLost& lost) {
    return lost.what();
  }
  ADD_FAILURE() << "nothing was lost";
  return {};
}

TEST(PreparationProcess, SaysHowAProgramEndedThatGaveNoAnswer) {
  EXPECT_EQ(loss("/bin/true"), "its process ended with exit code 0");
  EXPECT_EQ(loss("/bin/false"), "its process ended with exit code 1");
}

TEST(PreparationProcess, SaysThatAProgramIsMissing) {
  EXPECT_NE(loss("/nowhere/at/all").find("could not be started: No such file"), std::string::npos);
}

TEST(PreparationProcess, ACancelledOneIsNotStarted) {
  std::stop_source stop;
  stop.request_stop();
  try {
    (void)preprocess_apart("/bin/true", 1, testing::sample_surface(12, 1), {.report = {}, .stop = stop.get_token()});
    FAIL();
  } catch (const EngineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::cancelled);
  }
}

TEST(PreparationProcess, LeavesNoDescriptorBehind) {
  const int before = ::dup(0);
  ::close(before);
  for (int i = 0; i < 20; ++i) (void)loss(i % 2 == 0 ? "/bin/true" : "/nowhere/at/all");
  const int after = ::dup(0);
  ::close(after);
  EXPECT_EQ(after, before);
}

class Messages : public ::testing::Test {
 protected:
  Messages() { EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0); }
  ~Messages() override {
    ::close(ends[0]);
    if (ends[1] >= 0) ::close(ends[1]);
  }
  void hang_up() { ::close(std::exchange(ends[1], -1)); }
  void send_bytes(const std::vector<unsigned char>& bytes) const {
    EXPECT_EQ(::send(ends[1], bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }

  std::array<int, 2> ends{};
};

TEST_F(Messages, TravelWhole) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{5'000'000}}) {
    const std::vector<std::byte> body(size, std::byte{7});
    std::jthread sender([&] { EXPECT_TRUE(send_message(ends[1], MessageKind::sphere, body)); });
    const auto message = receive_message(ends[0]);
    ASSERT_TRUE(message);
    EXPECT_EQ(message->kind, MessageKind::sphere);
    EXPECT_EQ(message->body, body);
  }
}

TEST_F(Messages, AnEndIsNoMessage) {
  send_bytes({3, 100, 0, 0});  // in the middle of the header
  hang_up();
  EXPECT_FALSE(receive_message(ends[0]));
  EXPECT_FALSE(send_message(ends[0], MessageKind::progress, {}));
}

TEST_F(Messages, AFalseSizeAllocatesNothing) {
  send_bytes({3, 255, 255, 255, 255, 255, 255, 255, 127, 1, 2, 3});
  hang_up();
  EXPECT_FALSE(receive_message(ends[0]));
}

TEST_F(Messages, AnUnknownKindIsRefused) {
  for (const std::uint8_t kind : std::initializer_list<std::uint8_t>{0, 9, 255}) {
    send_bytes({kind, 0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_THROW((void)receive_message(ends[0]), StorageError);
  }
}

TEST(MessageBodies, Reports) {
  const ProgressReport report = decode_report(encode_report("conformal", 0.25));
  EXPECT_EQ(report.stage, "conformal");
  EXPECT_EQ(report.fraction, 0.25);
  EXPECT_THROW((void)decode_report({}), StorageError);
}

TEST(MessageBodies, Summaries) {
  PreprocessedShape shape;
  shape.sphere_quality = {1, 0.5, 0.25};
  shape.engine = "7";
  shape.seconds = {{"conformal", 1.5}, {"total", 2.5}};
  PreprocessedShape decoded;
  const auto body = encode_summary(shape);
  decode_summary(body, decoded);
  EXPECT_EQ(decoded.sphere_quality.flipped, 1);
  EXPECT_EQ(decoded.sphere_quality.solid_angle_defect, 0.5);
  EXPECT_EQ(decoded.sphere_quality.area_distortion, 0.25);
  EXPECT_EQ(decoded.engine, "7");
  EXPECT_EQ(decoded.seconds, shape.seconds);
  for (std::size_t size = 0; size < body.size(); ++size) {
    EXPECT_THROW(decode_summary(std::span(body).first(size), decoded), StorageError) << size;
  }
}

TEST(MessageBodies, Refusals) {
  for (const ErrorCode code : {ErrorCode::malformed_mesh, ErrorCode::parametrization_failed, ErrorCode::invalid_parameter}) {
    const EngineError error = decode_refusal(encode_refusal(EngineError(code, "a reason")));
    EXPECT_EQ(error.code(), code);
    EXPECT_STREQ(error.what(), "a reason");
  }
  auto body = encode_refusal(EngineError(ErrorCode::cancelled, ""));
  body[0] = std::byte{200};
  EXPECT_THROW((void)decode_refusal(body), StorageError);
}

}  // namespace
}  // namespace spherematch
