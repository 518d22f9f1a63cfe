// The page is what others build their peers from: its examples must be what the code sends.
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "frame_text.hpp"

namespace dashpot::board {
namespace {

std::string protocol_page() {
  std::ifstream file(PROTOCOL_PAGE);
  std::stringstream all;
  all << file.rdbuf();
  return all.str();
}

template <class Message>
void expect_on_page(const Message& message, std::uint32_t sequence) {
  const std::string bytes = in_hex(encode(message, sequence));
  EXPECT_NE(protocol_page().find("`" + bytes + "`"), std::string::npos) << "the page lacks " << bytes;
}

// A field added, moved or widened in the code alone would leave every other implementation behind.
TEST(ProtocolPage, ExamplesAreWhatIsSent) {
  expect_on_page(hello_message(), 0);
  expect_on_page(configure_message{1'000'000, 4.0F, 0.0F, 10, sampling::on_command, controller::host}, 0);
  expect_on_page(reset_message{1}, 0);
  expect_on_page(command_message{-0.5F, 3.0F}, 258);
  expect_on_page(sample_message{2'000'000'000, 1'999'500'000, -1234, -0.5F, 3.0F, 258, 1, board_state::running, {}},
                 772);
  expect_on_page(arm_command_message{{-0.5F, 0.25F}, {3, 2}}, 258);
  expect_on_page(
      arm_sample_message{
          2'000'000'000, {1'999'500'000, 0}, {-1234, 5678}, {-0.5F, 0.25F}, {3, 2}, 258, 1, board_state::running, {}},
      772);
}

template <class Message>
void expect_length_on_page(const char* name) {
  char row[64];
  std::snprintf(row, sizeof row, "| `0x%02X` | %s | ", unsigned(Message::type), name);
  const std::string page = protocol_page();
  const auto at = page.find(row);
  ASSERT_NE(at, std::string::npos) << row;
  const auto length = page.find("| ", at + std::char_traits<char>::length(row)) + 2;
  EXPECT_EQ(std::stoul(page.substr(length)), payload_size<Message>()) << row;
}

// The table of types and lengths is what a decoder is written from.
TEST(ProtocolPage, TypesAndLengthsAreTheCodes) {
  expect_length_on_page<hello_message>("hello");
  expect_length_on_page<description_message>("description");
  expect_length_on_page<configure_message>("configure");
  expect_length_on_page<configured_message>("configured");
  expect_length_on_page<reset_message>("reset");
  expect_length_on_page<command_message>("command");
  expect_length_on_page<sample_message>("sample");
  expect_length_on_page<ask_statistics_message>("ask statistics");
  expect_length_on_page<statistics_message>("statistics");
  expect_length_on_page<arm_description_message>("description");
  expect_length_on_page<arm_configure_message>("configure");
  expect_length_on_page<arm_command_message>("command");
  expect_length_on_page<arm_sample_message>("sample");
}

}  // namespace
}  // namespace dashpot::board
