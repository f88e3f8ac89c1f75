#!/usr/bin/env python3
"""Tests losses and chains of a tire on the user's mesh, an .inp, while it rolls, against the same tire described in TOML.

   rolling_deck_test.py PATH/TO/latsch"""
import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import WRONG_INPUT, Coarse

ROLLING = 'kind = "%s", load = "2 kN", speed = "60 km/h", pressure = "2.4 bar"'
BETA, TAU = 0.3, 0.002


class RollingDeck(Coarse):
    def setUp(self):
        super().setUp()
        self.tire, self.deck = self.folder / "relaxing.toml", self.folder / "tire.inp"
        text = (self.folder / "tire.toml").read_text()
        rubbers = text.replace('law = "neo-Hooke"\n', f'law = "neo-Hooke"\nprony = [[{BETA}, "{TAU} s"]]\n')
        self.assertGreater(rubbers.count("prony"), 2)
        self.tire.write_text(rubbers)
        self.latsch("export", self.folder / "tire.toml", "--ccx", self.deck)

    def relax(self, share=BETA / (1 + BETA), bulk=0):
        """Adds the terms to the rubbers of the deck, with the share of the instantaneous modulus."""
        lines, relaxing = [], False
        for line in self.deck.read_text().split("\n"):
            if line.upper().startswith("*DENSITY") and relaxing:
                lines += ["*VISCOELASTIC, TIME=PRONY", f"{share!r},{bulk},{TAU}"]
            lines.append(line)
            if line.startswith("*"):
                relaxing = line.upper().startswith("*HYPERELASTIC")
        self.deck.write_text("\n".join(lines))

    def channels(self, model, keys):
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", model, "{%s}" % keys, "--json"))
        return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}

    def test_the_deck_loses_what_the_described_tire_loses(self):
        self.relax()
        deck, tire = (self.channels(model, ROLLING % "rolling") for model in (self.deck, self.tire))
        self.assertGreater(tire["loss_rubber"][0], 10.0)
        self.assertAlmostEqual(deck["loss_rubber"][0] / tire["loss_rubber"][0], 1.0, delta=1e-3)
        self.assertAlmostEqual(deck["Fx"][0] / tire["Fx"][0], 1.0, delta=1e-3)
        owners = [name for name in deck if name.startswith("loss.material.")]
        self.assertAlmostEqual(sum(deck[name][0] for name in owners), deck["loss_rubber"][0], delta=1e-6 * deck["loss_rubber"][0])

    def test_an_elastic_deck_has_chains_and_says_that_nothing_relaxes(self):
        self.assertIn("rolling_resistance is that of friction alone", self.latsch("test", self.deck, "{%s}" % (ROLLING % "rolling")))
        chain = self.channels(self.deck, ROLLING % "rolling_chain" + ', position = [0, 0.5], depth = "outer"')
        described = self.channels(self.folder / "tire.toml", ROLLING % "rolling_chain" + ', position = [0, 0.5], depth = "outer"')
        self.assertEqual(len(chain["E_tt"]), len(described["E_tt"]))
        self.assertEqual(set(chain["dissipation"]), {0.0})
        for found, expected in zip(chain["v_x"], described["v_x"]):
            self.assertAlmostEqual(found, expected, delta=0.01)

    def test_wrong_terms_are_refused_with_their_line(self):
        self.relax(bulk=0.1)
        said = self.latsch("test", self.deck, "{%s}" % (ROLLING % "rolling"), code=WRONG_INPUT)
        for part in ("tire.inp:", "k is 0.1", "expected 0", "bulk modulus of rubber"):
            self.assertIn(part, said)

    def test_a_share_of_the_deck_is_a_number_of_a_study(self):
        self.relax()
        said = self.latsch("check", self.deck)
        self.assertIn(".g1", said)
        self.assertIn(".tau1", said)


if __name__ == "__main__":
    unittest.main()
