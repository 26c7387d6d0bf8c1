// Laws of text that is read from the right.
#include "viewer/window/reading_order.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

namespace curveskel::viewer::reading_order_laws {
namespace {

TEST(ReadingOrder, OtherTextStaysAsItIs) {
  std::string bytes;
  for (int byte = 0; byte < 0x80; ++byte) bytes.push_back(static_cast<char>(byte));
  for (int byte = 0x80; byte < 0x100; ++byte) bytes.push_back(static_cast<char>(byte));
  for (const std::string& text :
       {std::string(), std::string("upper_arm.L (2)"), std::string("左腕, Голова, κεφάλι, é"),
        std::string("\xf0\x9f\xa6\xb4 \xe4\xba"), bytes}) {
    EXPECT_EQ(in_reading_order(text), text);
  }
}

TEST(ReadingOrder, HebrewIsTurnedAndWhatIsRoundItStays) {
  EXPECT_EQ(in_reading_order("שלום"), "םולש");
  EXPECT_EQ(in_reading_order("opening שלום.obj"), "opening םולש.obj");
  EXPECT_EQ(in_reading_order("יד ימין"), "ןימי די") << "words, too";
  EXPECT_EQ(in_reading_order("א, b, ג"), "א, b, ג") << "not across what is read from the left";
}

TEST(ReadingOrder, NumbersKeepTheirOrderAndBracketsOpenTheOtherWay) {
  EXPECT_EQ(in_reading_order("יד 12.5 א"), "א 12.5 די");
  EXPECT_EQ(in_reading_order("יד 3.obj"), "3 די.obj");
  EXPECT_EQ(in_reading_order("א (ב) ג"), "ג (ב) א");
}

/// The letters' forms alone, at the end, at the beginning, within.
TEST(ReadingOrder, ArabicLettersJoin) {
  EXPECT_EQ(in_reading_order("ب"), "\xef\xba\x8f");
  // Three of them: at the end, within, at the beginning.
  EXPECT_EQ(in_reading_order("ببب"), "\xef\xba\x90\xef\xba\x92\xef\xba\x91");
  // Dal joins none after it: dhal-ra-alef-ain stands apart, and so does the last.
  EXPECT_EQ(in_reading_order("در"), "\xef\xba\xad\xef\xba\xa9");
  // Lam and alef are one, which joins the letter before.
  EXPECT_EQ(in_reading_order("لا"), "\xef\xbb\xbb");
  EXPECT_EQ(in_reading_order("بلا"), "\xef\xbb\xbc\xef\xba\x91");
}

TEST(ReadingOrder, VowelSignsStayWithTheirLetterAndPartNone) {
  // Ba with fatha, ba.
  EXPECT_EQ(in_reading_order("ب\xd9\x8eب"), "\xef\xba\x90\xef\xba\x91\xd9\x8e");
}

}  // namespace
}  // namespace curveskel::viewer::reading_order_laws
