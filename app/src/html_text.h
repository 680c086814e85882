// Text and bytes for HTML, SVG and XML.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace app {

// Text for HTML, SVG and XML, also within quoted attributes.
std::string Escaped(const std::string& text);

// RFC 4648, with padding: for data URIs.
std::string Base64(const std::vector<uint8_t>& bytes);

}  // namespace app
