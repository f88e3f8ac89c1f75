// SPDX-License-Identifier: Apache-2.0
// Prints a campaign of tests: what it rests on, the tests in their order, what is known after them,
// and how much better they are than a grid.
#pragma once

#include "correlation/campaign/campaign.h"

namespace latsch::cli {

/// Prints what is measured, with which noise, what is held, and the slopes used.
void print_design_ground(const correlation::Study& study,
                         const correlation::CampaignStart& start,
                         const correlation::Campaign& campaign);

/// Prints the tests and how often settings change.
void print_campaign_tests(const correlation::Study& study, const correlation::Campaign& campaign);

/// Prints the intervals of all free variables now and after the tests.
void print_standings(const correlation::Study& study,
                     const correlation::CampaignStart& start,
                     const correlation::Campaign& campaign);

/// Prints the comparison with a grid, the ranking at the ends of the intervals, and warnings.
void print_worth(const correlation::Study& study, const correlation::Campaign& campaign);

/// Adds all of it to the JSON answer.
void answer_design(const correlation::Study& study,
                   const correlation::CampaignStart& start,
                   const correlation::Campaign& campaign);

}  // namespace latsch::cli
