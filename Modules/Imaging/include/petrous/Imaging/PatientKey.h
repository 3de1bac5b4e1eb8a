#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>

namespace petrous::imaging
{

/// Hashes that distinguish patients: no patient data can reach a message. 0: not stated.
struct PatientKey
{
  std::size_t id = 0;     ///< (0010,0020)
  std::size_t issuer = 0; ///< (0010,0021) of the ID
  std::size_t name = 0;   ///< (0010,0010)
  std::size_t birthDate = 0;
  /// namePartKey of the words of the name, by which a surname is known in a text; 0: none.
  std::array<std::size_t, 6> nameParts{};
  /// foldedPartKey of the words of the name; 0: none. A name of none but numbers and words as
  /// "Phantom" has none of these, and no joinedName.
  std::array<std::size_t, 8> foldedParts{};
  /// Of all of these words joined, particles too: "vanderMeer" is "van der Meer".
  std::size_t joinedName = 0;

  bool empty() const { return id == 0 && name == 0 && birthDate == 0; }
};

/// The key of an identity as DICOM states it, in UTF-8. Writers differ in case, in spaces and in
/// the delimiters of a name's components: these do not count. "Anonymous" and the like are nobody.
/// Of a name only the first representation counts (PS3.5 6.2.1), as others may be absent. The same
/// in every run of the program.
PatientKey patientKey(const std::string& id, const std::string& issuer, const std::string& name,
                      const std::string& birthDate);

/// The key of one word of a name, or of a text; 0 for what is no name by itself: of less than three
/// letters, "von", "Phantom" and the like. Umlauts and their transcriptions (ue) are equal.
std::size_t namePartKey(const std::string& word);

/// The same without accents, and with ae, oe and ue as one letter: "Müller", "Mueller" and "Muller"
/// are equal, and "Łukasiewicz" is "Lukasiewicz". Words of one or two letters have one too, which
/// is no namePartKey and no patientKey of any text.
std::size_t foldedPartKey(const std::string& word);

/// Whether a word of a text, in UTF-8, is a part of a name or several of them joined, in any order,
/// with or without particles ("van") and accents. `isPart`: of the namePartKey or foldedPartKey of
/// a part of the word, whether it is one of the name's; never called with 0.
bool isOfName(const std::string& word, const std::function<bool(std::size_t)>& isPart);

/// In what two identities differ.
struct PatientDifferences
{
  bool id = false;
  bool name = false;
  bool birthDate = false;

  bool any() const noexcept { return id || name || birthDate; }
  void join(const PatientDifferences& other) noexcept
  {
    id = id || other.id;
    name = name || other.name;
    birthDate = birthDate || other.birthDate;
  }
};

/// Of what both state. IDs of different issuers are not compared. `Key` has the members of
/// PatientKey, each equal to its default value where it is not stated.
template <class Key>
PatientDifferences differencesOf(const Key& a, const Key& b)
{
  const auto differ = [](const auto& one, const auto& other)
  {
    const std::decay_t<decltype(one)> none{};
    return one != none && other != none && one != other;
  };
  return {!differ(a.issuer, b.issuer) && differ(a.id, b.id), differ(a.name, b.name),
          differ(a.birthDate, b.birthDate)};
}

/// Whether two identities may be of one patient: no ID, name or birth date that both state differs.
template <class Key>
bool samePatient(const Key& a, const Key& b)
{
  return !differencesOf(a, b).any();
}

} // namespace petrous::imaging
