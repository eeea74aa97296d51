#include "strainwave/common/files/content_hash.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(ContentHash, IsThePublishedFnv1a) {
  // Test vectors of L. C. Noll (www.isthe.com/chongo/tech/comp/fnv); journals and plans carry these numbers.
  EXPECT_EQ(content_hash(""), 0xcbf29ce484222325u);
  EXPECT_EQ(content_hash("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(content_hash("foobar"), 0x85944171f73967e8u);
  EXPECT_EQ(hash_text(content_hash("foobar")), "85944171f73967e8");
  EXPECT_EQ(hash_text(0x1f), "000000000000001f");
}

} // namespace
} // namespace strainwave
