#pragma once

namespace petrous::imaging
{

/// The sides of the patient towards which the axes of LPS fall and rise.
constexpr const char* kPatientSides[3][2] = {
    {"right", "left"}, {"anterior", "posterior"}, {"inferior", "superior"}};

} // namespace petrous::imaging
